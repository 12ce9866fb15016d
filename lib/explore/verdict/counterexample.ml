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

   Between two states there may be several transitions; one is wanted that has the right valuation. *)

let choices x (c, outside) = Environment.choices x.options x.program x.world outside c

let valuation x (t : Transition.t) =
  let valuations = Labelling.valuations x.labelling in
  Valuation.valuation valuations (Valuation.action valuations t) (Valuation.state valuations t.next)

let step x i j is_right =
  let c, outside = State_graph.state x.graph j in
  let leads ((t : Transition.t), e) =
    x.tick ();
    Environment.compare e outside = 0 && Configuration.equal t.next c && is_right (valuation x t)
  in
  match Environment.find leads (choices x (State_graph.state x.graph i)) with
  | Some (t, _) -> t
  | None -> Fmt.invalid_arg "Counterexample.step: no transition from state %d to state %d" i j

let rec through x = function
  | i :: (j :: _ as rest) ->
    let monitor = Labelling.monitor x.labelling and set = State_graph.set x.graph in
    let t = step x i j (fun valuation -> Monitor.next monitor ~give:ignore (set i) valuation = set j) in
    t :: through x rest
  | [ _ ] | [] -> []

let rec around x i = function
  | [] -> []
  | (j, wanted) :: rest ->
    let t = step x i j (Int.equal wanted) in
    t :: around x j rest

let last states = List.nth states (List.length states - 1)

(* {1 Runs that are violations whatever follows} *)

module States = Hashtbl.Make (struct
    type t = Configuration.t * Environment.t

    let equal (c, e) (c', e') = Environment.compare e e' = 0 && Configuration.equal c c'
    let hash (c, e) = (Configuration.hash c + Environment.hash e) land max_int
  end)

(* The run continues with the first of the choices, to its end, or to a visited state. *)
let onwards x states =
  let seen = States.create 100 in
  let rec go state taken =
    x.tick ();
    match States.find_opt seen state with
    | Some n -> (n, List.rev taken)
    | None -> (
        let n = List.length taken in
        States.add seen state n;
        let choices = choices x state in
        let is_stuck = Environment.is_stuck x.options x.program (snd state) choices in
        match if is_stuck then None else Environment.find (fun _ -> true) choices with
        | Some ((t : Transition.t), outside) -> go (t.next, outside) (t :: taken)
        | None -> (n, List.rev taken))
  in
  let back, taken = go (State_graph.state x.graph (last states)) [] in
  let before = List.filteri (fun k _ -> k < back) taken and cycle = List.filteri (fun k _ -> k >= back) taken in
  { steps = through x states @ before; cycle; decided = Some (List.length states - 1) }

let of_violation ~tick options program world graph labelling (violation : Breadth_first.violation) =
  let x = { options; program; world; graph; labelling; tick } in
  match violation with
  | Whatever_follows states -> onwards x states
  | Around { stem; cycle } -> { steps = through x stem; cycle = around x (last stem) cycle; decided = None }
