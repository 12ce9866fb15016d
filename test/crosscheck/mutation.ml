let applied m = Mutant.apply m Translated.specification

let all_apply () =
  let applies (m : Mutant.t) =
    match applied m with
    | Ok _ -> true
    | Error why -> Printf.printf "%s: does not apply: %s\n%!" m.name why; false
  in
  List.for_all Fun.id (List.map applies (Mutant.about ""))

(* {1 Who notices} *)

(* The parts that do not affect the comparison. *)
let malformed = "Parsing or semantic analysis failed."

type notice = Noticed_by of string | Unnoticed | Malformed

let of_failure why =
  let line = List.hd (String.split_on_char '\n' why) in
  if line = malformed then Malformed else Noticed_by ("TLC: " ^ line)

let differing (r : Batch.result) = match r.verdict with Agrees -> None | Differs _ | Not_printed -> Some r.name

let rec by_graphs installation specification = function
  | [] -> Unnoticed
  | some :: rest -> (
      match Batch.run installation ~specification some with
      | Error why -> of_failure why
      | Ok { results; _ } -> (
          match List.find_map differing results with
          | Some name -> Noticed_by name
          | None -> by_graphs installation specification rest))

let rec by_verdicts installation specification = function
  | [] -> Unnoticed
  | (c : Case.t) :: rest -> (
      match Judged.verdicts ~specification installation c with
      | Error why -> of_failure why
      | Ok (Judged { agree = false; tlc; explorer }) ->
        Noticed_by (Printf.sprintf "%s; TLC: %s, the explorer: %s" c.name tlc explorer)
      | Ok (Judged { agree = true; _ } | Not_translated _) -> by_verdicts installation specification rest)

let by_refinement installation specification batches =
  let rec go = function
    | [] -> Unnoticed
    | some :: rest -> (
        match Refined.programs installation specification some with Error why -> of_failure why | Ok () -> go rest)
  in
  go batches

let by_dates installation specification prepared =
  match Dated.programs installation specification prepared with Error why -> of_failure why | Ok () -> Unnoticed

let by_theorems installation specification =
  match Refined.theorems installation specification with Error why -> of_failure why | Ok () -> Unnoticed

(* {1 All of them} *)

let look installation ~dated batches (m : Mutant.t) =
  let outcome =
    Result.map
      (fun specification ->
         if Mutant.is_of_checking m then by_verdicts installation specification Small_programs.verdicts
         else if Mutant.is_of_abstract m then by_theorems installation specification
         else if Mutant.is_of_refinement m then by_refinement installation specification batches
         else if Mutant.is_of_time m then by_dates installation specification dated
         else by_graphs installation specification batches)
      (applied m)
  in
  match outcome with
  | Error why -> Printf.printf "%s: does not apply: %s\n%!" m.name why; false
  | Ok Malformed -> Printf.printf "%s: is no specification\n%!" m.name; false
  | Ok Unnoticed -> Printf.printf "%s: NOT NOTICED\n%!" m.name; false
  | Ok (Noticed_by what) -> Printf.printf "%s: noticed by %s\n%!" m.name what; true

let run installation ~only ~limit ~batch ~small ~random ~dated =
  let by_states a b = Int.compare (Batch.states a) (Batch.states b) in
  let small = List.stable_sort by_states (Comparison.prepare ~limit small) in
  let random = Comparison.prepare ~limit random in
  Printf.printf "%d small programs, %d random ones\n%!" (List.length small) (List.length random);
  let batches = Comparison.batches batch small @ Comparison.batches batch random in
  let noticed = Parallel.map (look installation ~dated batches) (Mutant.about only) in
  let count = List.length (List.filter Fun.id noticed) in
  Printf.printf "%d of %d mistakes were noticed\n" count (List.length noticed);
  count = List.length noticed
