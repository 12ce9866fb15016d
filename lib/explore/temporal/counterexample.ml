open Dolphin_semantics
open Dolphin_environment
open Dolphin_ltl

type run = { steps : Transition.t list; cycle : Transition.t list }

type t = {
  options : Environment.options;
  program : Core.program;
  world : World.t;
  space : Space.t;
  watch : Product.t;
}

(* {1 Transitions}

   Between two states there may be several transitions; one is wanted that has the right letter. *)

let choices x (c, outside) = Environment.choices x.options x.program x.world outside c

let letter x (t : Transition.t) =
  let letters = Product.letters x.watch in
  Valuation.letter letters (Valuation.action letters t) (Valuation.state letters t.next)

let step x i j is_right =
  let c, outside = Space.state x.space j in
  let leads ((t : Transition.t), e) =
    Environment.compare e outside = 0 && Configuration.equal t.next c && is_right (letter x t)
  in
  match List.find_opt leads (choices x (Space.state x.space i)) with
  | Some (t, _) -> t
  | None -> Fmt.invalid_arg "Counterexample.step: no transition from state %d to %d" i j

let stem x i =
  let monitor = Product.monitor x.watch and watched = Space.watched x.space in
  let step i j = step x i j (fun letter -> Monitor.next monitor (watched i) letter = watched j) in
  let rec go = function i :: (j :: _ as rest) -> let t = step i j in t :: go rest | [ _ ] | [] -> [] in
  go (Replay.shortest x.space i)

(* {1 Runs that are violations whatever follows} *)

module States = Hashtbl.Make (struct
    type t = Configuration.t * Environment.t

    let equal (c, e) (c', e') = Environment.compare e e' = 0 && Configuration.equal c c'
    let hash (c, e) = (Configuration.hash c + Environment.hash e) land max_int
  end)

(* The run goes on by the first of the choices, to its end, or to where it has been. *)
let onwards tick x i =
  let seen = States.create 100 in
  let rec go state taken =
    tick ();
    match States.find_opt seen state with
    | Some n -> (n, List.rev taken)
    | None -> (
        let n = List.length taken in
        States.add seen state n;
        match choices x state with
        | ((t : Transition.t), outside) :: _ as choices when Environment.goes_on choices ->
          go (t.next, outside) (t :: taken)
        | _ -> (n, List.rev taken))
  in
  let back, taken = go (Space.state x.space i) [] in
  let before = List.filteri (fun k _ -> k < back) taken and cycle = List.filteri (fun k _ -> k >= back) taken in
  { steps = stem x i @ before; cycle }

(* {1 Cycles}

   Nodes are pairs of a state of the space and a state of the automaton, among those that the watch knows of. A cycle
   goes through the script, and its states of the automaton are in one component. *)

let graph x : int Cycles.graph =
  let monitor = Product.monitor x.watch in
  let q = Monitor.automaton_states monitor in
  let component = Monitor.component monitor in
  let successors node =
    let from = node mod q in
    let after (into, letter) =
      let continued q' = if component q' = component from then Some ((into * q) + q', letter) else None in
      List.filter_map continued (Monitor.after monitor from letter)
    in
    List.concat_map after (Space.arrivals x.space (node / q))
  in
  let is_in node set = Monitor.is_in monitor (node mod q) set in
  { successors; sets = Monitor.acceptance_sets monitor; is_in }

let starts x =
  let monitor = Product.monitor x.watch in
  let q = Monitor.automaton_states monitor in
  let of_state i =
    let node q' = if Monitor.component monitor q' < 0 then None else Some ((i * q) + q') in
    if Space.executes x.space i then []
    else List.filter_map node (Monitor.members monitor (Space.watched x.space i))
  in
  let rec from i found = if i < 0 then found else from (i - 1) (of_state i @ found) in
  from (Space.count x.space - 1) []

let cyclic tick x =
  let graph = graph x and q = Monitor.automaton_states (Product.monitor x.watch) in
  let lasso component =
    let start = Cycles.first component in
    let around = Cycles.around graph component start in
    let rec go i = function
      | [] -> []
      | (node, wanted) :: rest ->
        let t = step x i (node / q) (Int.equal wanted) in
        t :: go (node / q) rest
    in
    { steps = stem x (start / q); cycle = go (start / q) around }
  in
  Option.map lasso (Cycles.find ~tick graph (starts x))

let find ?(tick = ignore) options program world space watch =
  let x = { options; program; world; space; watch } in
  match Space.shown space with
  | Some i -> Some (onwards tick x i)
  | None -> if Space.may_cycle space then cyclic tick x else None
