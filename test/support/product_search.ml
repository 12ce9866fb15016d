open Dolphin_ltl

type 'letter graph = { start : int * 'letter; successors : int -> (int * 'letter) list }
type 'letter lasso = { stem : (int * 'letter) list; cycle : (int * 'letter) list }

(* The product: its states are numbered, each a state of the graph and one of the automaton. *)
type 'letter product = {
  starts : (int * 'letter) list;
  successors : int -> (int * 'letter) list;
  pair : int -> int * int;
}

let product ~tick ~holds (g : 'letter graph) a =
  let numbers = Hashtbl.create 1_000 and pairs = ref [||] in
  let number pair =
    match Hashtbl.find_opt numbers pair with
    | Some i -> i
    | None ->
      tick ();
      let i = Hashtbl.length numbers in
      Hashtbl.add numbers pair i;
      if i = Array.length !pairs then pairs := Array.append !pairs (Array.make (max 64 i) pair);
      !pairs.(i) <- pair;
      i
  in
  let arrivals states (s, letter) =
    List.filter_map (fun q -> if Automaton.admits a q (holds letter) then Some (number (s, q), letter) else None) states
  in
  let pair i = !pairs.(i) in
  let successors i =
    let s, q = pair i in
    List.concat_map (arrivals (Automaton.successors a q)) (g.successors s)
  in
  { starts = arrivals (Automaton.initial a) g.start; successors; pair }

let rec last = function
  | [ (i, _) ] -> i
  | _ :: rest -> last rest
  | [] -> invalid_arg "Product_search.last: an empty way"

let satisfying ?(tick = ignore) ~holds g f =
  let a = Automaton.of_formula f in
  let { starts; successors; pair } = product ~tick ~holds g a in
  let is_in i set = Automaton.is_in a (snd (pair i)) set in
  let product : _ Cycles.graph = { successors; sets = Automaton.acceptance_sets a; is_in } in
  let lasso component =
    match Cycles.way product ~within:(fun _ -> true) ~goal:(Cycles.mem component) starts with
    | None -> invalid_arg "Product_search.satisfying: a component that is not reached"
    | Some stem ->
      let state (i, letter) = (fst (pair i), letter) in
      { stem = List.map state stem; cycle = List.map state (Cycles.around product component (last stem)) }
  in
  Option.map lasso (Cycles.find product (List.map fst starts))
