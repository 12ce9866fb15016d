open Dolphin_semantics
open Dolphin_environment

type state = { configuration : Configuration.t; outside : Environment.t }

type t = {
  options : Environment.options;
  program : Core.program;
  states : state array; edges : (Transition.t * int) list array; depths : int array }

module Table = Hashtbl.Make (struct
    type t = state

    let equal a b =
      Environment.compare a.outside b.outside = 0 && Configuration.equal a.configuration b.configuration

    let hash s = Configuration.hash s.configuration + Environment.hash s.outside
  end)

exception Too_many

let explore ?(limit = 100_000) ?start options program world =
  let configuration, outside = Option.value start ~default:(Configuration.initial program, Environment.initial) in
  let numbers = Table.create 1_000 and queue = Queue.create () in
  let states = ref [] and edges = ref [] and depths = ref [] in
  let number depth s =
    match Table.find_opt numbers s with
    | Some i -> i
    | None ->
      let i = Table.length numbers in
      Table.add numbers s i;
      states := s :: !states;
      depths := depth :: !depths;
      Queue.add (s, depth) queue;
      if i >= limit then raise_notrace Too_many;
      i
  in
  let rec go () =
    match Queue.take_opt queue with
    | None ->
      let array xs = Array.of_list (List.rev !xs) in
      { options; program; states = array states; edges = array edges; depths = array depths }
    | Some (s, depth) ->
      let edge ((t : Transition.t), outside) = (t, number (depth + 1) { configuration = t.next; outside }) in
      let choices = Environment.choices options program world s.outside s.configuration in
      edges := List.of_seq (Seq.map edge choices) :: !edges;
      go ()
  in
  match
    ignore (number 0 { configuration; outside });
    go ()
  with
  | graph -> Some graph
  | exception Too_many -> None

let transitions g = Array.fold_left (fun n edges -> n + List.length edges) 0 g.edges
let depth g = Array.fold_left max 0 g.depths

(* The fewest transitions of a run that meets a state twice: to the state, and around the cycle. *)
let shortest_lasso g =
  let around start =
    let seen = Hashtbl.create 100 and queue = Queue.create () in
    Queue.add (start, 0) queue;
    let rec go () =
      match Queue.take_opt queue with
      | None -> None
      | Some (i, n) ->
        let found = List.exists (fun (_, j) -> j = start) g.edges.(i) in
        if found then Some (n + 1)
        else begin
          let add (_, j) =
            if not (Hashtbl.mem seen j) then begin
              Hashtbl.add seen j ();
              Queue.add (j, n + 1) queue
            end
          in
          List.iter add g.edges.(i);
          go ()
        end
    in
    go ()
  in
  let better best i =
    match around i, best with
    | None, best -> best
    | Some n, Some m when g.depths.(i) + n >= m -> best
    | Some n, (Some _ | None) -> Some (g.depths.(i) + n)
  in
  List.fold_left better None (List.init (Array.length g.states) Fun.id)

(* Removing states without successors, repeatedly, leaves nothing if there is no cycle of states with [within]. *)
let is_cyclic ?(within = fun _ -> true) g =
  let n = Array.length g.states in
  let edge i (_, j) = within g.states.(i) && within g.states.(j) in
  let edges = Array.mapi (fun i -> List.filter (edge i)) g.edges in
  let missing = Array.map List.length edges in
  let before = Array.make n [] in
  Array.iteri (fun i -> List.iter (fun (_, j) -> before.(j) <- i :: before.(j))) edges;
  let removed = ref 0 in
  let rec remove i =
    incr removed;
    let less j =
      missing.(j) <- missing.(j) - 1;
      if missing.(j) = 0 then remove j
    in
    List.iter less before.(i)
  in
  let ends = List.filter (fun i -> edges.(i) = []) (List.init n Fun.id) in
  List.iter remove ends;
  !removed < n

let executes s =
  match s.configuration.control with Executing _ -> true | Script _ | Waiting _ | Ended _ -> false

let goes_round g = is_cyclic ~within:executes g

let broken g =
  let found = Hashtbl.create 7 in
  let note property depth =
    match Hashtbl.find_opt found property with
    | Some known when known <= depth -> ()
    | Some _ | None -> Hashtbl.replace found property depth
  in
  let edge depth ((t : Transition.t), _) =
    Option.iter (fun property -> note property (depth + 1)) (Property.broken_by_end g.program t.rules t.next)
  in
  let state i s =
    List.iter (edge g.depths.(i)) g.edges.(i);
    match s.configuration.control with
    | Ended _ -> ()
    | Script _ | Waiting _ | Executing _ ->
      if Environment.is_stuck g.options g.program s.outside (List.to_seq g.edges.(i)) then note No_deadlock g.depths.(i)
  in
  Array.iteri state g.states;
  if is_cyclic g && not (goes_round g) then Option.iter (note Termination) (shortest_lasso g);
  List.filter_map
    (fun p -> Option.map (fun depth -> (p, depth)) (Hashtbl.find_opt found p))
    Property.all
