let theorems installation specification =
  let abstract = List.filter (fun (name, _) -> name = "Abstract.tla") specification in
  Tlc_run.judge
    (Tlc_run.outcome installation ~main:"SmallAbstract" ~configuration:"SmallAbstract.cfg"
       (abstract
        @ [ ("SmallAbstract.tla", Small_abstract.model); ("SmallAbstract.cfg", Small_abstract.configuration) ]))

let programs installation specification prepared =
  Result.bind (Family.files ~specification (List.map Batch.constants prepared)) (fun files ->
      Tlc_run.judge (Tlc_run.outcome installation ~main:Family.refined ~configuration:Family.refinement files))

(* How many programs fail. Of several, each half is looked at by itself then. *)
let rec failures_of installation prepared =
  match programs installation Translated.specification prepared, prepared with
  | Ok (), _ -> 0
  | Error why, [ one ] ->
    let case = Batch.case one in
    Printf.printf "%s: %s\n%s\n%!" case.name why case.source;
    1
  | Error _, _ -> Comparison.in_halves (failures_of installation) prepared

let report installation ~limit ~batch cases =
  let start = Unix.gettimeofday () in
  let prepared = Comparison.prepare ~limit cases in
  let of_theorems =
    match theorems installation Translated.specification with
    | Ok () -> 0
    | Error why -> Printf.printf "Abstract.tla: %s\n%!" why; 1
  in
  let found = Parallel.map (failures_of installation) (Comparison.batches batch prepared) in
  let failures = List.fold_left ( + ) of_theorems found in
  Printf.printf "refinement of Abstract.tla: its theorems, and %d programs, %s states: %s\n  %.0f s\n%!"
    (List.length prepared)
    (Comparison.thousands (List.fold_left (fun n p -> n + Batch.states p) 0 prepared))
    (if failures = 0 then "all hold" else Printf.sprintf "%d do not" failures)
    (Unix.gettimeofday () -. start);
  { Comparison.programs = List.length prepared; failures }
