module Reference = Dolphin_explore.Reference

type count = { programs : int; failures : int }

let passed c = c.programs > 0 && c.failures = 0

let thousands n =
  let digits = string_of_int n in
  let rec group i = if i <= 3 then String.sub digits 0 i else group (i - 3) ^ "," ^ String.sub digits (i - 3) 3 in
  group (String.length digits)

let rec batches size = function
  | [] -> []
  | all ->
    let rec split n taken = function
      | x :: rest when n > 0 -> split (n - 1) (x :: taken) rest
      | rest -> (List.rev taken, rest)
    in
    let first, rest = split size [] all in
    first :: batches size rest

let sum f = List.fold_left (fun total x -> total + f x) 0

let in_halves f all =
  let half = List.length all / 2 in
  let part keep = f (List.filteri (fun i _ -> keep i) all) in
  let first = part (fun i -> i < half) in
  first + part (fun i -> i >= half)

let timed f =
  let start = Unix.gettimeofday () in
  let result = f () in
  (result, Unix.gettimeofday () -. start)

let tell_failure name source what = Printf.printf "%s: %s\n%s\n%!" name what source

(* {1 State graphs} *)

(* The programs that were prepared; the names of the others, with why they were not. *)
let prepared_or_not ~limit cases =
  let one (c : Case.t) = match Batch.prepare ~limit c with Ok p -> Either.Left p | Error why -> Right (c.name, why) in
  List.partition_map one cases

let prepare ~limit cases = fst (prepared_or_not ~limit cases)

(* Whether the two agree; a difference is printed. *)
let agrees (r : Batch.result) =
  match r.verdict with
  | Agrees -> true
  | Not_printed -> tell_failure r.name r.source "TLC found no state of it"; false
  | Differs difference ->
    tell_failure r.name r.source
      (Format.asprintf "left is the explorer, right TLC@.%a" Dolphin_lts.Isomorphism.pp_difference difference);
    false

(* How many programs do not agree, or have a warning. If TLC fails, it gets each half of the programs by itself. *)
let rec failures_of installation prepared =
  match Batch.run installation ~specification:Translated.specification prepared, prepared with
  | Ok { results; warnings; _ }, _ ->
    List.iter (Printf.printf "warning: %s\n%!") warnings;
    List.length warnings + List.length (List.filter (fun r -> not (agrees r)) results)
  | Error why, [ one ] ->
    let case = Batch.case one in
    tell_failure case.name case.source why;
    1
  | Error _, _ -> in_halves (failures_of installation) prepared

let verdict_of failures = if failures = 0 then "all agree" else Printf.sprintf "%d do not agree" failures

let graphs title installation ~limit ~batch cases =
  let (prepared, others, failures), seconds =
    timed (fun () ->
        let prepared, others = prepared_or_not ~limit cases in
        (prepared, others, sum Fun.id (Parallel.map (failures_of installation) (batches batch prepared))))
  in
  let refused (name, (why : Batch.unfit)) =
    match why with Refused why | Unsettled why -> Some (name, why) | Too_large -> None
  in
  let refusals = List.filter_map refused others in
  let too_large = List.length others - List.length refusals in
  Printf.printf "%s: %d programs, %s states, %s transitions: %s%s%s\n" title (List.length prepared)
    (thousands (sum Batch.states prepared))
    (thousands (sum Batch.transitions prepared))
    (verdict_of failures)
    (if too_large > 0 then Printf.sprintf "; %d left out as too large" too_large else "")
    (if refusals <> [] then Printf.sprintf "; %d refused by the translation" (List.length refusals) else "");
  List.iter (fun (name, why) -> Printf.printf "  refused: %s: %s\n" name why) refusals;
  Printf.printf "  %.0f s\n%!" seconds;
  { programs = List.length prepared; failures }

(* {1 Verdicts} *)

let is_small (c : Case.t) =
  match Reference.explore ~limit:300 c.environment c.program c.world with
  | Some _ -> true
  | None | (exception Dolphin_environment.Environment.Unclear _) -> false

(* TLC's verdict, and whether it is the explorer's; [None] if the program cannot be translated. *)
let judge installation (c : Case.t) =
  match Judged.verdicts installation c with
  | Error why -> tell_failure c.name c.source why; Some ("none", false)
  | Ok (Not_translated _) -> None
  | Ok (Judged { tlc; explorer; agree }) ->
    if not agree then tell_failure c.name c.source (Printf.sprintf "TLC: %s; the explorer: %s" tlc explorer);
    Some (tlc, agree)

let verdicts installation cases =
  let judged, seconds = timed (fun () -> Parallel.map (judge installation) (List.filter is_small cases)) in
  let done_ = List.filter_map Fun.id judged in
  let refused = List.length judged - List.length done_ in
  let failures = List.length (List.filter (fun (_, agree) -> not agree) done_) in
  let kinds = List.sort_uniq compare (List.map fst done_) in
  let count kind = Printf.sprintf "%s: %d" kind (List.length (List.filter (fun (k, _) -> k = kind) done_)) in
  Printf.printf "verdicts: %d programs, each checked by TLC's own properties: %s%s\n  %s\n  %.0f s\n%!"
    (List.length done_)
    (verdict_of failures)
    (if refused > 0 then Printf.sprintf "; %d refused by the translation" refused else "")
    (String.concat "; " (List.map count kinds))
    seconds;
  { programs = List.length done_; failures }
