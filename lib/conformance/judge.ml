module Rules = Walks.Rules

type failure = { kind : string; why : string }
type verdict = { failures : failure list; rules : string list }

let show_code (code, line) = Option.fold ~none:code ~some:(Printf.sprintf "%s in line %d" code) line

let show_codes = function
  | [] -> "nothing"
  | codes -> String.concat ", " (List.map show_code codes)

(* {1 Rejections} *)

let same_code (code, line) (code', line') = code = code' && (line = None || line = line')

let rejected expected seen =
  if List.length expected = List.length seen && List.for_all2 same_code expected seen then Ok ()
  else Error (Printf.sprintf "expected %s, seen %s" (show_codes expected) (show_codes seen))

(* {1 Outcomes} *)

let show_outcome (o : Case.outcome) =
  let message = Option.fold ~none:"" ~some:(Printf.sprintf " (%s)") o.message in
  Printf.sprintf "%s%s with N {%s}" o.how message (String.concat ", " o.left)

let same_outcome (e : Case.outcome) (s : Case.outcome) =
  e.how = s.how && e.left = s.left && (e.message = None || e.message = s.message)

let outcomes expected seen =
  let missing = List.filter (fun e -> not (List.exists (same_outcome e) seen)) expected in
  let unexpected = List.filter (fun s -> not (List.exists (fun e -> same_outcome e s) expected)) seen in
  let tell what = function [] -> [] | xs -> [ what ^ " " ^ String.concat "; " (List.map show_outcome xs) ] in
  match tell "expected and not seen:" missing @ tell "seen and not expected:" unexpected with
  | [] -> Ok ()
  | wrong -> Error (String.concat "; " wrong)

let deadlock expected (all : Walks.all) =
  let stuck = List.exists (fun (o : Case.outcome) -> o.how = "stuck") all.outcomes in
  if stuck = expected then Ok ()
  else if stuck then Error "expected none, and some run gets stuck"
  else Error "expected a run that gets stuck, and none does"

(* {1 Times} *)

let times expected seen = Option.fold ~none:(Ok ()) ~some:Result.error (Timed_data.difference expected seen)

let findings expected seen =
  if expected = seen then Ok ()
  else
    Error (Printf.sprintf "expected %s, seen %s" (Timed_data.show_findings expected) (Timed_data.show_findings seen))

(* {1 Cases} *)

let expectation ask (case : Case.t) start (e : Case.expectation) : Walks.found =
  let nobody why = (Error why, Rules.empty) in
  let of_all check =
    match start with
    | Error codes -> nobody ("the program is rejected: " ^ show_codes codes)
    | Ok place -> (
        match Walks.all ask case.environment place with
        | Error why -> nobody why
        | Ok all -> (check all, all.rules))
  in
  let along walk steps =
    match start with
    | Error codes -> nobody ("the program is rejected: " ^ show_codes codes)
    | Ok place -> walk ask place steps
  in
  let timed check =
    match start with
    | Error codes -> nobody ("the program is rejected: " ^ show_codes codes)
    | Ok _ -> (check (), Rules.empty)
  in
  let faults = case.environment.faults in
  match e with
  | Rejected codes -> ((match start with Error seen -> rejected codes seen | Ok _ -> rejected codes []), Rules.empty)
  | Trace steps -> along Walks.trace steps
  | Admits steps -> along Walks.admits steps
  | Forbids steps -> along Walks.forbids steps
  | Outcomes expected -> of_all (fun (all : Walks.all) -> outcomes expected all.outcomes)
  | Deadlock expected -> of_all (deadlock expected)
  | Times expected -> timed (fun () -> times expected (Dialogue.times ask ~faults))
  | Dated { run; findings = expected } -> timed (fun () -> findings expected (Dialogue.dated ask ~faults run))

let covers (case : Case.t) rules =
  match List.filter (fun rule -> not (Rules.mem rule rules)) case.covers with
  | [] -> []
  | missing -> [ { kind = "covers"; why = "no step is by " ^ String.concat ", " missing } ]

let judge ask (case : Case.t) =
  match
    let start = Dialogue.initial ask ~program:case.program ~fleet:case.fleet in
    let look (failures, rules) e =
      let result, taken = expectation ask case start e in
      let failed = match result with Ok () -> [] | Error why -> [ { kind = Case.kind e; why } ] in
      (failures @ failed, Rules.union taken rules)
    in
    List.fold_left look ([], Rules.empty) case.expectations
  with
  | failures, rules ->
    (* Parts that were not reached because of another fault need not be reported as well. *)
    let covers = if failures = [] then covers case rules else [] in
    { failures = failures @ covers; rules = Rules.elements rules }
  | exception Dialogue.Trouble why -> { failures = [ { kind = "implementation"; why } ]; rules = [] }

let passes (case : Case.t) verdict =
  List.sort_uniq compare (List.map (fun f -> f.kind) verdict.failures) = List.sort_uniq compare case.fails
