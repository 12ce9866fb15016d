open Dolphin_semantics
open Dolphin_checker

module Labels = Interner.Make (struct
    type t = string

    let equal = String.equal
    let hash = Hashtbl.hash
  end)

(* The actions of transitions are their labels. These numbers may differ between processes: no state contains them. *)
let labels () =
  let labels = Labels.create (Numbering.create ()) in
  let nothing = Labels.number labels "" in
  assert (nothing = Observer.nothing);
  labels

let observer labels : Observer.t =
  { action = (fun observed -> Labels.number labels (Format.asprintf "%a" Label.pp observed.label));
    valuation = (fun _ _ _ -> 0) }

type t = { graph : State_graph.t; ids : int array (* by state: its number in [graph] *) }

let states t = Array.length t.ids
let state t i = State_graph.state t.graph t.ids.(i)

(* States in the order in which transitions come to them: several processes have numbered them as it happened. *)
let list_in_order graph labels each =
  let highest = ref 0 in
  State_graph.iter graph (fun id -> highest := max !highest id);
  let numbers = Array.make (!highest + 1) (-1) and ids = Array.make (State_graph.count graph) 0 in
  let known = ref 0 in
  let number id =
    if numbers.(id) < 0 then begin
      numbers.(id) <- !known;
      ids.(!known) <- id;
      incr known
    end;
    numbers.(id)
  in
  let tick = State_graph.ticker graph "listing transitions" in
  let list i id =
    let take (arrival : State_graph.arrival) = each i (Labels.value labels arrival.action) (number arrival.into) in
    tick ();
    List.iter take (State_graph.arrivals graph id)
  in
  ignore (number 0 : int);
  Array.iteri list ids;
  { graph; ids }

type problem = Stopped of Limits.bound | Unclear of Fault.t

let explore ?workers ?fork_from limits options program world each =
  let labels = labels () in
  let space = Space.create ~observer:(observer labels) options program world in
  let graph = State_graph.create ?workers ?fork_from limits space in
  State_graph.run graph;
  match Space.unclear space, State_graph.stopped graph with
  | Some fault, _ -> Error (Unclear fault)
  | None, Some bound -> Error (Stopped bound)
  | None, None -> (
      match list_in_order graph labels each with
      | system -> Ok system
      | exception Limits.Stop bound -> Error (Stopped bound)
      | exception Out_of_memory -> Error (Stopped No_memory))
