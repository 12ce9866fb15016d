open Dolphin_semantics
open Dolphin_environment
open Dolphin_checker
open Dolphin_ltl

type run = { steps : Transition.t list; cycle : Transition.t list; decided : int option }

type t = {
  options : Environment.options;
  program : Core.program;
  world : World.t;
  graph : State_graph.t;
  labelling : Labelling.t;
  tick : unit -> unit;
}

(* {1 Transitions}

   Between two states there may be several transitions; one is wanted that has the right valuation. Where states of the
   graph represent others up to the names of vehicles, the run goes on from its own. *)

type state = Configuration.t * Environment.t

let choices x (c, outside) = Space.choices (State_graph.system x.graph) outside c
let representative x (c, outside) = Space.canonical (State_graph.system x.graph) c outside
let equal (c, e) (c', e') = Environment.compare e e' = 0 && Configuration.equal c c'

let valuation x (t : Transition.t) =
  let valuations = Labelling.valuations x.labelling in
  Valuation.valuation valuations (Valuation.action valuations t) (Valuation.state valuations t.next)

(* The text of an error may name another vehicle than that of its representative. *)
let ends_alike x (c : Configuration.t) (c' : Configuration.t) =
  let state = Valuation.state (Labelling.valuations x.labelling) in
  Configuration.has_ended c && Configuration.has_ended c' && state c = state c'

(* A transition from [state] to one that is represented by that numbered [j]. *)
let step x (state : state) j is_right : Transition.t * state =
  let ((c, _) as wanted) = representative x (State_graph.state x.graph j) in
  let find is_it =
    let leads (((t : Transition.t), _) as choice) =
      x.tick ();
      is_it choice && is_right (valuation x t)
    in
    Environment.find leads (choices x state)
  in
  let leads ((t : Transition.t), e) = equal (representative x (t.next, e)) wanted in
  let found = match find leads with None -> find (fun (t, _) -> ends_alike x t.next c) | found -> found in
  match found with
  | Some (t, outside) -> (t, (t.next, outside))
  | None -> Fmt.invalid_arg "Counterexample.step: no transition to state %d" j

let rec through x state = function
  | i :: (j :: _ as rest) ->
    let monitor = Labelling.monitor x.labelling and set = State_graph.set x.graph in
    let t, next = step x state j (fun valuation -> Monitor.next monitor ~give:ignore (set i) valuation = set j) in
    let state, found = through x next rest in
    (state, t :: found)
  | [ _ ] | [] -> (state, [])

let from_start x states = through x (State_graph.state x.graph 0) states

(* One round, which may lead to another state that the same one represents. *)
let rec around x state = function
  | [] -> (state, [])
  | (j, wanted) :: rest ->
    let t, next = step x state j (Int.equal wanted) in
    let state, found = around x next rest in
    (state, t :: found)

(* {1 Runs that are violations whatever follows} *)

module States = Hashtbl.Make (struct
    type t = state

    let equal = equal
    let hash (c, e) = (Configuration.hash c + Environment.hash e) land max_int
  end)

(* A run that goes on for longer is shown up to the step that decides. *)
let most_onwards = 10_000

(* The run continues with the first of the choices, to its end, or to a visited state. *)
let onwards x states =
  let last, stem = from_start x states in
  let seen = States.create 100 in
  let rec go n state taken =
    x.tick ();
    match States.find_opt seen state with
    | Some n -> Some (n, List.rev taken)
    | None when n = most_onwards -> None
    | None -> (
        States.add seen state n;
        let choices = Environment.choices x.options x.program x.world (snd state) (fst state) in
        let is_stuck = Environment.is_stuck x.options x.program (snd state) choices in
        match if is_stuck then None else Environment.find (fun _ -> true) choices with
        | Some ((t : Transition.t), outside) -> go (n + 1) (t.next, outside) (t :: taken)
        | None -> Some (n, List.rev taken))
  in
  let back, taken = Option.value (go 0 last []) ~default:(0, []) in
  let before = List.filteri (fun k _ -> k < back) taken and cycle = List.filteri (fun k _ -> k >= back) taken in
  { steps = stem @ before; cycle; decided = Some (List.length states - 1) }

let of_violation ~tick options program world graph labelling (violation : Breadth_first.violation) =
  let x = { options; program; world; graph; labelling; tick } in
  match violation with
  | Whatever_follows states -> onwards x states
  | Around { stem; cycle } -> (
      let state, stem = from_start x stem in
      match Rounds.closed ~equal (fun state -> Some (around x state cycle)) state with
      | Some (before, cycle) -> { steps = stem @ before; cycle; decided = None }
      | None -> invalid_arg "Counterexample.of_violation")
