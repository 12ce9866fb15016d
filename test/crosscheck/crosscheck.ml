(* TLC and the explorer, each with its own statement of the semantics, on the same programs: as many states, isomorphic
   graphs, equal labels, derivations and ends.

   crosscheck.exe [quick | all | mutate | coverage | counts]. In the environment: PROGRAMS, how many random programs;
   SEED; LIMIT, the most states of one; BATCH, how many are given to TLC at once; VERDICTS, of how many random programs
   TLC's own verdict is asked, which takes a start of TLC for each; ONLY, a part of the names of the mistakes that are
   made. *)

open Dolphin_tlc

let number name default = match Sys.getenv_opt name with Some n -> int_of_string n | None -> default
let seed = number "SEED" 4
let examples_directory = Option.value (Sys.getenv_opt "EXAMPLES") ~default:"examples"

let thousands n =
  let digits = string_of_int n in
  let rec group i = if i <= 3 then String.sub digits 0 i else group (i - 3) ^ "," ^ String.sub digits (i - 3) 3 in
  group (String.length digits)

(* {1 Preparing} *)

type tally = {
  mutable programs : int;
  mutable states : int;
  mutable transitions : int;
  mutable too_large : int;
  mutable refused : (string * string) list;
  mutable failures : int;
  mutable verdicts : (string * int) list;  (* of TLC, with how many have them *)
}

let tally () = { programs = 0; states = 0; transitions = 0; too_large = 0; refused = []; failures = 0; verdicts = [] }

let prepare t ~limit cases =
  let one (c : Case.t) =
    match Batch.prepare ~limit c with
    | Ok prepared -> Some prepared
    | Error Too_large -> t.too_large <- t.too_large + 1; None
    | Error (Refused why | Unsettled why) -> t.refused <- (c.name, why) :: t.refused; None
  in
  List.filter_map one cases

let rec batches size = function
  | [] -> []
  | all ->
    let rec split n taken = function
      | x :: rest when n > 0 -> split (n - 1) (x :: taken) rest
      | rest -> (List.rev taken, rest)
    in
    let first, rest = split size [] all in
    first :: batches size rest

(* {1 Comparing} *)

let counting verdict all =
  let n = Option.value (List.assoc_opt verdict all) ~default:0 in
  List.sort compare ((verdict, n + 1) :: List.remove_assoc verdict all)

let tell_failure t (case : Case.t) what =
  t.failures <- t.failures + 1;
  Printf.printf "%s: %s\n%s\n%!" case.name what case.source

let note t (r : Batch.result) =
  t.programs <- t.programs + 1;
  t.states <- t.states + r.states;
  t.transitions <- t.transitions + r.transitions;
  match r.verdict with
  | Agrees -> ()
  | Not_printed -> tell_failure t r.case "TLC found no state of it"
  | Differs difference ->
    tell_failure t r.case
      (Format.asprintf "left is the explorer, right TLC@.%a" Dolphin_lts.Isomorphism.pp_difference difference)

let rec compare_batch t installation ~specification prepared =
  match Batch.run installation ~specification prepared, prepared with
  | Ok { results; warnings; _ }, _ ->
    List.iter (note t) results;
    List.iter
      (fun warning ->
         t.failures <- t.failures + 1;
         Printf.printf "warning: %s\n%!" warning)
      warnings
  | Error why, [ one ] -> t.programs <- t.programs + 1; tell_failure t (Batch.case one) why
  | Error _, _ -> List.iter (fun one -> compare_batch t installation ~specification [ one ]) prepared

let summary title t =
  Printf.printf "%s: %d programs, %s states, %s transitions: %s" title t.programs (thousands t.states)
    (thousands t.transitions)
    (if t.failures = 0 then "all agree" else Printf.sprintf "%d do not agree" t.failures);
  if t.too_large > 0 then Printf.printf "; %d left out as too large" t.too_large;
  if t.refused <> [] then Printf.printf "; %d refused by the translation" (List.length t.refused);
  print_newline ();
  List.iter (fun (name, why) -> Printf.printf "  refused: %s: %s\n" name why) (List.rev t.refused);
  flush stdout

let compare_all title installation ~limit ~batch cases =
  let t = tally () in
  let start = Unix.gettimeofday () in
  let specification = Translated.specification in
  List.iter (compare_batch t installation ~specification) (batches batch (prepare t ~limit cases));
  summary title t;
  Printf.printf "  %.0f s\n%!" (Unix.gettimeofday () -. start);
  t

(* {1 Verdicts} *)

(* What TLC says of one program, by its own properties, and what the explorer does: TLC stops at its first violation. *)
let judge_verdict installation t (c : Case.t) =
  match Judged.verdicts installation c with
  | Error why -> t.programs <- t.programs + 1; tell_failure t c why
  | Ok Not_translated -> t.refused <- (c.name, "") :: t.refused
  | Ok (Judged { tlc; explorer; agree }) ->
    t.programs <- t.programs + 1;
    t.verdicts <- counting tlc t.verdicts;
    if not agree then tell_failure t c (Printf.sprintf "TLC: %s; the explorer: %s" tlc explorer)

(* TLC takes minutes for the temporal properties of some programs of a thousand states. *)
let is_small (c : Case.t) =
  match Dolphin_explore.Reference.explore ~limit:300 c.environment c.program c.world with
  | Some _ -> true
  | None | (exception Dolphin_semantics.Reading.Unsettled _) -> false

let compare_verdicts installation cases =
  let t = tally () and start = Unix.gettimeofday () in
  List.iter (judge_verdict installation t) (List.filter is_small cases);
  Printf.printf "verdicts: %d programs, each checked by TLC's own properties: %s" t.programs
    (if t.failures = 0 then "all agree" else Printf.sprintf "%d do not agree" t.failures);
  if t.refused <> [] then Printf.printf "; %d refused by the translation" (List.length t.refused);
  Printf.printf "\n  %s\n  %.0f s\n%!"
    (String.concat "; " (List.map (fun (verdict, n) -> Printf.sprintf "%s: %d" verdict n) t.verdicts))
    (Unix.gettimeofday () -. start);
  t

(* {1 The commands} *)

let all installation =
  let limit = number "LIMIT" 2_000 and batch = number "BATCH" 50 and programs = number "PROGRAMS" 400 in
  Printf.printf "SEED=%d PROGRAMS=%d LIMIT=%d BATCH=%d\n%!" seed programs limit batch;
  let examples = compare_all "examples" installation ~limit:20_000 ~batch:10 (Case.examples examples_directory) in
  let faulty = compare_all "examples with faults" installation ~limit:4_000 ~batch:10 (Case.faulty_examples examples_directory) in
  let traps = compare_all "traps" installation ~limit ~batch (Case.traps @ Case.sensor_traps @ Case.faulty_traps) in
  let random = compare_all "random programs" installation ~limit ~batch (Case.random ~seed programs) in
  let sensing = compare_all "random programs with sensors" installation ~limit ~batch (Case.sensing ~seed programs) in
  let verdicts =
    compare_verdicts installation
      (Case.examples examples_directory @ Case.traps @ Case.sensor_traps @ Case.random ~seed (number "VERDICTS" 20))
  in
  List.for_all (fun t -> t.failures = 0 && t.programs > 0) [ examples; faulty; traps; random; sensing; verdicts ]

let quick installation =
  let limit = number "LIMIT" 150 and programs = number "PROGRAMS" 30 in
  let t =
    compare_all "examples, traps, random programs" installation ~limit ~batch:1000
      (Case.examples examples_directory @ Case.faulty_examples examples_directory @ Case.traps @ Case.sensor_traps @ Case.faulty_traps
       @ Case.random ~seed programs @ Case.sensing ~seed programs)
  in
  t.failures = 0 && t.programs > 50

(* What says nothing about the comparison. *)
let malformed = "TLC: Parsing or semantic analysis failed."

let mutate installation =
  let limit = number "LIMIT" 150 and programs = number "PROGRAMS" 60 in
  let prepare = prepare (tally ()) ~limit in
  let traps = prepare (Case.traps @ Case.sensor_traps @ Case.faulty_traps) and random = prepare (Case.random ~seed programs @ Case.sensing ~seed programs) in
  Printf.printf "SEED=%d: %d traps, %d random programs\n%!" seed (List.length traps) (List.length random);
  let caught (r : Batch.result) = match r.verdict with Agrees -> None | Differs _ | Not_printed -> Some r.case.name in
  let rec catch specification = function
    | [] -> None
    | some :: rest -> (
        match Batch.run installation ~specification some with
        | Error why -> Some ("TLC: " ^ List.hd (String.split_on_char '\n' why))
        | Ok { results; _ } -> (
            match List.find_map caught results with
            | Some name -> Some name
            | None -> catch specification rest))
  in
  let one (m : Mutant.t) =
    let outcome =
      Result.map (fun specification -> catch specification (traps :: batches (number "BATCH" 25) random))
        (Mutant.apply m Translated.specification)
    in
    match outcome with
    | Error why -> Printf.printf "%s: does not apply: %s\n%!" m.name why; false
    | Ok None -> Printf.printf "%s: NOT NOTICED\n%!" m.name; false
    | Ok (Some by) when by = malformed -> Printf.printf "%s: is no specification\n%!" m.name; false
    | Ok (Some by) -> Printf.printf "%s: noticed by %s\n%!" m.name by; true
  in
  let noticed = List.map one (Mutant.about (Option.value (Sys.getenv_opt "ONLY") ~default:"")) in
  let count = List.length (List.filter Fun.id noticed) in
  Printf.printf "%d of %d mutants were noticed\n" count (List.length noticed);
  count = List.length noticed

let print_count (c : Covered.counted) =
  Printf.printf "%-16s %10s %12s\n" (Dolphin_semantics.Rule.name c.rule) (thousands c.taken) (thousands c.derivations)

let names rules = String.concat ", " (List.map Dolphin_semantics.Rule.name rules)

let print_counts counts =
  Printf.printf "%-16s %10s %12s\n" "rule" "taken" "derivations";
  List.iter print_count counts

(* TLC's -coverage comes to an end, and counts what there is to count. *)
let counts installation =
  match Covered.count installation (prepare (tally ()) ~limit:150 Case.traps) with
  | Error why -> prerr_endline why; false
  | Ok (counts, _) ->
    let wrong = Covered.miscounted counts in
    if wrong <> [] then begin
      print_endline "TLC -coverage counts these rules otherwise than derivations do:";
      print_counts wrong
    end;
    wrong = [] && List.exists (fun (c : Covered.counted) -> c.derivations > 0) counts

let coverage installation =
  let start = Unix.gettimeofday () in
  let t = tally () in
  let cases =
    prepare t ~limit:20_000 (Case.examples examples_directory)
    @ prepare t ~limit:4_000 (Case.faulty_examples examples_directory)
  in
  match Covered.count installation cases with
  | Error why -> prerr_endline why; false
  | Ok (counts, batch) ->
    Printf.printf "%d programs, in one run of TLC with -coverage: %.0f s\n" (List.length cases)
      (Unix.gettimeofday () -. start);
    print_counts counts;
    let missing = Covered.missing counts in
    if missing <> [] then Printf.printf "USED BY NO EXAMPLE: %s\n" (names missing);
    List.iter (note t) batch.results;
    missing = [] && t.failures = 0

let () =
  let command = if Array.length Sys.argv > 1 then Sys.argv.(1) else "all" in
  let run f =
    match Installation.find Sys.getenv_opt with
    | Ok installation -> exit (if f installation then 0 else 1)
    | Error trouble when command = "quick" || command = "counts" ->
      Format.printf "skipped: crosscheck %s: %a@." command Installation.pp_trouble trouble
    | Error trouble -> Format.eprintf "%a@." Installation.pp_trouble trouble; exit 2
  in
  match command with
  | "all" -> run all
  | "quick" -> run quick
  | "mutate" -> run mutate
  | "coverage" -> run coverage
  | "counts" -> run counts
  | other -> Printf.eprintf "%s: not one of all, quick, mutate, coverage, counts\n" other; exit 2
