(* TLC and the explorer, each with its own statement of the semantics, on the same programs: as many states, isomorphic
   graphs, equal labels, effects, derivations and ends.

   crosscheck.exe [quick | all | mutate | refinement | dates | coverage | counts | rules]. In the environment: PROGRAMS,
   how many random programs; SEED; LIMIT, the most states of one; TICKS, the most ticks of one whose dates are compared;
   BATCH, how many are given to TLC at once; VERDICTS, of how many random programs TLC's own verdict is asked, which
   takes a start of TLC for each; ONLY, a part of the names of the mistakes that are made; JOBS, how many processes run
   at once. *)

open Dolphin_tlc

let number name default = match Sys.getenv_opt name with Some n -> int_of_string n | None -> default
let seed = number "SEED" 4
let examples_directory = Option.value (Sys.getenv_opt "EXAMPLES") ~default:"examples"
let examples () = Case.examples examples_directory
let faulty_examples () = Case.faulty_examples examples_directory

(* Programs that are over within a number of ticks: small ones, [random] random ones, and examples. *)
let dated ~random ~ticks =
  Dated.prepare ~ticks:40 ~states:400 Dated.small
  @ Dated.prepare ~ticks ~states:400 (Dated.random ~seed random)
  @ Dated.prepare ~ticks ~states:60 (Dated.examples examples_directory)

let all installation =
  let limit = number "LIMIT" 2_000 and batch = number "BATCH" 50 and programs = number "PROGRAMS" 400 in
  Printf.printf "SEED=%d PROGRAMS=%d LIMIT=%d BATCH=%d JOBS=%d\n%!" seed programs limit batch Parallel.jobs;
  let random = Case.random ~seed in
  let graphs = Comparison.graphs in
  let plain = examples () in
  let examples = graphs "examples" installation ~limit:20_000 ~batch:10 plain in
  let faulty = graphs "examples with faults" installation ~limit:4_000 ~batch:10 (faulty_examples ()) in
  let small = graphs "small programs" installation ~limit ~batch Small_programs.all in
  let random_ones = graphs "random programs" installation ~limit ~batch (random programs) in
  let sensing = graphs "random programs with sensors" installation ~limit ~batch (Case.sensing ~seed programs) in
  let verdicts =
    Comparison.verdicts installation
      (plain @ Small_programs.all @ random (number "VERDICTS" 20))
  in
  let dates = Dated.report installation ~batch (dated ~random:programs ~ticks:20) in
  List.for_all Comparison.passed [ examples; faulty; small; random_ones; sensing; verdicts; dates ]

(* The part that `dune test` runs, in some ten seconds. *)
let quick installation =
  let limit = number "LIMIT" 150 and programs = number "PROGRAMS" 30 in
  let graphs =
    Comparison.graphs "examples, small and random programs" installation ~limit ~batch:1000
      (examples () @ faulty_examples () @ Small_programs.all @ Case.random ~seed programs @ Case.sensing ~seed programs)
  in
  let verdicts = Comparison.verdicts installation (List.filteri (fun i _ -> i < 2) Small_programs.loops) in
  let refined = Refined.report installation ~limit:30 ~batch:1000 Small_programs.all in
  let dates =
    Dated.report installation ~batch:1000 (dated ~random:programs ~ticks:8)
  in
  Mutation.all_apply ()
  && List.for_all Comparison.passed [ refined; graphs; verdicts; dates ]
  && graphs.programs > 50 && dates.programs > 30

(* Whether programs refine spec/Abstract.tla; PROGRAMS random ones of each kind. *)
let refinement installation =
  let limit = number "LIMIT" 1_000 and programs = number "PROGRAMS" 100 and batch = number "BATCH" 40 in
  Printf.printf "SEED=%d PROGRAMS=%d LIMIT=%d BATCH=%d JOBS=%d\n%!" seed programs limit batch Parallel.jobs;
  Comparison.passed
    (Refined.report installation ~limit ~batch
       (examples () @ faulty_examples () @ Small_programs.all @ Case.random ~seed programs
        @ Case.sensing ~seed programs))

(* Earliest and latest dates; PROGRAMS random programs, TICKS at most. *)
let dates installation =
  let programs = number "PROGRAMS" 400 and batch = number "BATCH" 40 and ticks = number "TICKS" 20 in
  Printf.printf "SEED=%d PROGRAMS=%d TICKS=%d BATCH=%d JOBS=%d\n%!" seed programs ticks batch Parallel.jobs;
  Comparison.passed (Dated.report installation ~batch (dated ~random:programs ~ticks))

let mutate installation =
  let programs = number "PROGRAMS" 60 in
  Printf.printf "SEED=%d PROGRAMS=%d JOBS=%d: %!" seed programs Parallel.jobs;
  Mutation.run installation
    ~only:(Option.value (Sys.getenv_opt "ONLY") ~default:"")
    ~limit:(number "LIMIT" 150) ~batch:(number "BATCH" 50) ~small:Small_programs.all
    ~random:(Case.random ~seed programs @ Case.sensing ~seed programs)
    ~dated:(Dated.prepare ~ticks:40 ~states:400 Dated.small)

(* {1 Coverage} *)

let print_count (c : Covered.counted) =
  Printf.printf "%-16s %10s %12s\n" (Dolphin_semantics.Rule.name c.rule) (Comparison.thousands c.taken)
    (Comparison.thousands c.derivations)

let names rules = String.concat ", " (List.map Dolphin_semantics.Rule.name rules)

let print_counts counts =
  Printf.printf "%-16s %10s %12s\n" "rule" "taken" "derivations";
  List.iter print_count counts

(* TLC's -coverage comes to an end, and counts what there is to count. *)
let counts installation =
  match Covered.count installation (Comparison.prepare ~limit:150 Small_programs.all) with
  | Error why -> prerr_endline why; false
  | Ok (counts, _) ->
    let wrong = Covered.miscounted counts in
    if wrong <> [] then begin
      print_endline "TLC -coverage counts these rules otherwise than derivations do:";
      print_counts wrong
    end;
    wrong = [] && List.exists (fun (c : Covered.counted) -> c.derivations > 0) counts

(* Each rule is used by small graphs, too, and TLC's -coverage takes far longer than its search. *)
let covering () =
  let prepare = Comparison.prepare in
  prepare ~limit:4_000 (examples ()) @ prepare ~limit:500 (faulty_examples ())

let none_missing missing =
  if missing <> [] then Printf.printf "USED BY NO EXAMPLE: %s\n" (names missing);
  missing = []

(* The same, by the explorer alone, which takes seconds. *)
let rules () =
  let cases = covering () in
  let is_unused rule = not (List.exists (fun p -> Batch.uses p rule) cases) in
  none_missing (List.filter is_unused Dolphin_semantics.Rule.all)

let coverage installation =
  let start = Unix.gettimeofday () in
  let cases = covering () in
  match Covered.count installation cases with
  | Error why -> prerr_endline why; false
  | Ok (counts, batch) ->
    Printf.printf "%d programs, in one run of TLC with -coverage: %.0f s\n" (List.length cases)
      (Unix.gettimeofday () -. start);
    print_counts counts;
    none_missing (Covered.missing counts) && List.for_all (fun (r : Batch.result) -> r.verdict = Agrees) batch.results

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
  | "rules" -> exit (if rules () then 0 else 1)
  | "all" -> run all
  | "quick" -> run quick
  | "mutate" -> run mutate
  | "refinement" -> run refinement
  | "dates" -> run dates
  | "coverage" -> run coverage
  | "counts" -> run counts
  | other -> Printf.eprintf "%s: not one of all, quick, mutate, refinement, dates, coverage, counts\n" other; exit 2
