open Dolphin_semantics
open Dolphin_environment

(* A graph, and the call at each choice that is looked at. *)
type again = { graph : State_graph.t; tick : unit -> unit }

let choices { graph; _ } (c, outside) = Space.choices (State_graph.system graph) outside c

let find { tick; _ } is_it found =
  let look choice =
    tick ();
    is_it choice
  in
  Environment.find look found

let take x state leads ~from ~into =
  match find x leads (choices x state) with
  | Some choice -> choice
  | None -> Fmt.invalid_arg "Replay: no transition from state %d to state %d" from into

let equal (c, outside) (c', outside') = Environment.compare outside outside' = 0 && Configuration.equal c c'

(* {1 Through representatives}

   Where the states of a task are representatives of their classes, its first state and the script after it are still
   exact, up to the names of vehicles. The permutations in between are found from the end. *)

let permutation graph i j =
  let leads (arrival : State_graph.arrival) = arrival.into = j in
  match List.find_opt leads (State_graph.arrivals graph i) with
  | Some arrival -> arrival.via
  | None -> Fmt.invalid_arg "Rebuilt_run.permutation: no step from state %d to state %d" i j

(* Each of [states], which follow each other in the task, with its permutation; [last] is that of the last one. *)
let rec permutations graph last = function
  | [] -> []
  | [ i ] -> [ (i, last) ]
  | i :: (j :: _ as rest) -> (
      match permutations graph last rest, permutation graph i j with
      | ((_, p) :: _ as found), Some q -> (i, Task_group.compose p q) :: found
      | _, _ -> Fmt.invalid_arg "Rebuilt_run.permutations: state %d" i)

(* Those of [states] in the task of the first one; the symmetry of the task; and the states after it. *)
let rec task graph = function
  | i :: rest -> (
      match State_graph.view graph i with
      | Up_to (g, state) ->
        let states, _, after = task graph rest in
        ((i, state) :: states, Some g, after)
      | Exact _ -> ([], None, i :: rest))
  | [] -> ([], None, [])

let follow ({ graph; _ } as x) g start ~from states after =
  let space = State_graph.system graph in
  let numbers = List.map fst states in
  let final = List.nth numbers (List.length numbers - 1) in
  let last =
    match after with
    | w :: _ -> Option.value (permutation graph final w) ~default:(Task_group.identity g)
    | [] -> Task_group.identity g
  in
  let step (state, from, found) ((i, representative), (_, p)) =
    let wanted = Task_group.apply g p representative in
    (* Vehicles get their names where the task begins. *)
    let reached ((t : Transition.t), e) = if found = [] then Space.canonical space t.next e else (t.next, e) in
    let leads choice =
      let c, e = reached choice in
      Space.is_in_class space g wanted c e
    in
    let choice = take x state leads ~from ~into:i in
    (reached choice, i, choice :: found)
  in
  let state, last, found =
    List.fold_left step (start, from, []) (List.combine states (permutations graph last numbers))
  in
  (state, last, List.rev found)

(* {1 In the names of the graph} *)

let broken_by_end graph = Property.broken_by_end (Space.program (State_graph.system graph))

(* An end by an error may have another text than its representative. *)
let ends_in_same_way graph property ((t : Transition.t), _) =
  broken_by_end graph t.rules t.next = property && Configuration.has_ended t.next

let leads_to ({ graph; _ } as x) i state =
  let is_it ((t : Transition.t), e) =
    equal (t.next, e) state || equal (Space.canonical (State_graph.system graph) t.next e) state
  in
  fun found ->
    match find x is_it found with
    | Some choice -> Some choice
    | None -> find x (ends_in_same_way graph (State_graph.broken_by graph i)) found

(* Transitions from state to state, each from the target of the one before, or from its representative. The result is
   latest first. *)
let in_names_of ({ graph; _ } as x) states =
  let rec go state from found = function
    | [] -> found
    | i :: rest as states -> (
        match State_graph.view graph i with
        | Exact (c, outside) -> (
            match leads_to x i (c, outside) (choices x state) with
            | Some choice -> go (c, outside) i (choice :: found) rest
            | None -> Fmt.invalid_arg "Replay: no transition from state %d to state %d" from i)
        | Up_to _ -> (
            match task graph states with
            | inside, Some g, after ->
              let state, last, inside = follow x g state ~from inside after in
              go state last (List.rev_append inside found) after
            | _, None, _ -> invalid_arg "Rebuilt_run.in_names_of"))
  in
  match states with
  | [] -> []
  | i :: rest -> (
      match State_graph.view graph i with
      | Exact (c, outside) -> List.rev (go (c, outside) i [] rest)
      | Up_to _ -> invalid_arg "Replay: a run that starts inside of a task")

(* {1 Runs} *)

(* The transitions from [state] on whose targets are in the orbits of those of [images], one after the other, and the
   state that they lead to. *)
let real ({ graph; _ } as x) state images =
  let step (state, found) (((image : Transition.t), e) as choice) =
    let t, e =
      if not (Space.has_vehicle_symmetry (State_graph.system graph)) then choice
      else
        let wanted = Space.canonical (State_graph.system graph) image.next e in
        let is_it ((t : Transition.t), e) = equal (Space.canonical (State_graph.system graph) t.next e) wanted in
        let offered = choices x state in
        match find x is_it offered with
        | Some choice -> choice
        | None -> (
            match find x (ends_in_same_way graph (broken_by_end graph image.rules image.next)) offered with
            | Some choice when Configuration.has_ended image.next -> choice
            | Some _ | None -> invalid_arg "Replay: a configuration of the orbit has no such transition")
    in
    ((t.next, e), t :: found)
  in
  let state, found = List.fold_left step (state, []) images in
  (state, List.rev found)

let from_start x states =
  match State_graph.view x.graph 0 with
  | Exact (c, outside) -> real x (c, outside) (in_names_of x states)
  | Up_to _ -> invalid_arg "Replay: a run that starts inside of a task"

let through ~tick graph states = snd (from_start { graph; tick } states)

let around ~tick graph ~stem states =
  let x = { graph; tick } in
  let state, stem = from_start x stem in
  let images = in_names_of x states in
  match Rounds.closed ~equal (fun state -> Some (real x state images)) state with
  | Some (before, cycle) -> (stem @ before, cycle)
  | None -> invalid_arg "Rebuilt_run.around"
