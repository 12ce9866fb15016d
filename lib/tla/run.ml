let main = "Run"

type property = { name : string; of_runs : bool }

let check = "Run.cfg"
let check_states = "RunStates.cfg"
let graph = "RunGraph.cfg"

(* What [dolphin explore] asks of a program comes first, in its order; the rest is asked of the specification. *)
let properties ~strict =
  let invariant name = { name; of_runs = false } in
  List.map invariant [ "NoDeadlock"; "NoError"; "Assertions"; "EnoughVehicles" ]
  @ (if strict then List.map invariant [ "NoHalt"; "NoLeftover" ] else [])
  @ List.map invariant [ "TypeOK"; "AllocationWithinBound"; "OneTaskEach"; "EmptyAfterEnd"; "TuplesConserved" ]
  @ [ { name = "Termination"; of_runs = true } ]

let printing =
  {|(* Prints the state and its transitions, of the program with this number: TLC evaluates an invariant once a state. *)
PrintMark(text) == PrintT("M\t" \o text)

PrintEnd ==
  LET ending == control.ending
  IN PrintMark("ended: " \o
       CASE ending.how = "completed" -> IF NothingLeft THEN "completed" ELSE "completed, with tuples left"
         [] ending.how = "interrupted" -> "interrupted"
         [] OTHER -> ending.how \o ": " \o ending.message)

PrintMarks ==
  /\ control.at = "end" => PrintEnd
  /\ B # << >> => PrintMark("B " \o Join(B, ", "))
  /\ \A v \in DOMAIN A : PrintMark("A " \o v \o ": " \o A[v].name)
  /\ \A k \in OrderedKeys :
       N.queue[k] # << >> => PrintMark("N " \o PairsText(Each(N.queue[k], LAMBDA x : << k, x >>)) \o " in order")
  /\ \A pair \in DOMAIN N.bag : PrintMark("N " \o PairText(pair) \o " * " \o ToString(N.bag[pair]))

PrintGraphOf(number) ==
  LET here == ToString(number) \o ": "
  IN /\ PrintT("S\t" \o here \o StateText(control, Shared, outside) \o "\t" \o ToString(number))
     /\ PrintMarks
     /\ \A ts \in { Known(vars) } : \A j \in DOMAIN ts :
          PrintT("E\t" \o ts[j].label \o "\t" \o here \o StateText(ts[j].control, ts[j].S, Remembered(ts[j]))
                 \o "\t" \o Join(ts[j].rules, ", "))
|}

let text =
  {|---- MODULE Run ----
(* MC, with a variable that tells which step was taken last: no part of the state, for it is not in the VIEW. *)
EXTENDS MC

VARIABLE label

RunInit == Init /\ label = ""
RunNext == \E ts \in { Known(vars) } : \E j \in DOMAIN ts : Becomes(ts[j]) /\ label' = ts[j].label
RunSpec == RunInit /\ [][RunNext]_<< vars, label >> /\ Fairness

|}
  ^ printing ^ "\nPrintRun == PrintGraphOf(1)\n====\n"

let text_of model name = (List.find (fun (f : Model.file) -> f.name = name) model).text

(* The constants are those of MC.cfg: its lines from CONSTANTS on that are indented. *)
let constants model =
  let is_indented line = line <> "" && line.[0] = ' ' in
  let rec from = function
    | "CONSTANTS" :: rest -> "CONSTANTS" :: indented rest
    | _ :: rest -> from rest
    | [] -> []
  and indented = function line :: rest when is_indented line -> line :: indented rest | _ -> [] in
  String.concat "\n" (from (String.split_on_char '\n' (text_of model "MC.cfg"))) ^ "\n"

let configuration model properties =
  let named of_runs keyword =
    let names = List.filter_map (fun p -> if p.of_runs = of_runs then Some p.name else None) properties in
    if names = [] then "" else Printf.sprintf "%s %s\n" keyword (String.concat " " names)
  in
  "SPECIFICATION RunSpec\nVIEW vars\n" ^ constants model ^ named false "INVARIANTS" ^ named true "PROPERTIES"
  ^ "CHECK_DEADLOCK FALSE\n"

let files ~strict (model : Model.file list) : Model.file list =
  let properties = properties ~strict in
  let of_states = List.filter (fun p -> not p.of_runs) properties in
  model
  @ [ ({ name = main ^ ".tla"; text } : Model.file); { name = check; text = configuration model properties };
      { name = check_states; text = configuration model of_states };
      { name = graph; text = configuration model [ { name = "PrintRun"; of_runs = false } ] } ]
