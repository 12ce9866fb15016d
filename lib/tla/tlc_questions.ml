let main = "MC"

type property = { name : string; of_runs : bool }

let check = "Run.cfg"
let check_states = "RunStates.cfg"
let graph = "Graph.cfg"

(* The questions of [dolphin explore] come first, in its order; the rest is asked of the specification. *)
let properties ~strict =
  let invariant name = { name; of_runs = false } in
  List.map invariant [ "NoDeadlock"; "NoError"; "Assertions"; "EnoughVehicles" ]
  @ (if strict then List.map invariant [ "NoHalt"; "NoLeftover" ] else [])
  @ List.map invariant [ "TypeOK"; "AllocationWithinBound"; "OneTaskEach"; "RecruitedOnce"; "EmptyAfterEnd";
                         "TuplesConserved" ]
  @ [ { name = "Termination"; of_runs = true } ]

(* MC.cfg, up to the properties that it checks. *)
let beginning model =
  let text = (List.find (fun (f : Model.file) -> f.name = "MC.cfg") model).text in
  let rec before = function
    | line :: rest when not (String.length line > 10 && String.sub line 0 10 = "INVARIANTS") -> line :: before rest
    | _ -> []
  in
  String.concat "\n" (before (String.split_on_char '\n' text)) ^ "\n"

let configuration model properties =
  let named of_runs keyword =
    let names = List.filter_map (fun p -> if p.of_runs = of_runs then Some p.name else None) properties in
    if names = [] then "" else Printf.sprintf "%s %s\n" keyword (String.concat " " names)
  in
  beginning model ^ named false "INVARIANTS" ^ named true "PROPERTIES" ^ "CHECK_DEADLOCK FALSE\n"

let files ~strict (model : Model.file list) : Model.file list =
  let properties = properties ~strict in
  let of_states = List.filter (fun p -> not p.of_runs) properties in
  model
  @ [ { name = check; text = configuration model properties };
      { name = check_states; text = configuration model of_states } ]
