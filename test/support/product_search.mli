(** Runs of a graph whose letters satisfy a formula: the product of the graph with the formula's automaton, searched for
    strongly connected components that meet all acceptance sets. It takes no stack. It is plain, and takes some words
    for each state: the explorer does the same with {!Monitor} and {!Cycles} in a few bytes, and is compared with
    this. *)

open Dolphin_ltl

(** A graph: a letter stands at each arrival in a state. *)
type 'letter graph = {
  start : int * 'letter;  (** the first state and its letter *)
  successors : int -> (int * 'letter) list;
  (** states, each with the letter at the arrival; a state without successors would end the run: let it be its own
      successor *)
}

(** States, each with the letter at the arrival. *)
type 'letter lasso = {
  stem : (int * 'letter) list;  (** from the start; not empty *)
  cycle : (int * 'letter) list;  (** repeated without end after the stem; its last state is that of the stem. Not
                                     empty *)
}

val satisfying :
  ?tick:(unit -> unit) -> holds:('letter -> 'p -> bool) -> 'letter graph -> 'p Formula.t -> 'letter lasso option
(** [satisfying ~holds g f] is a run of [g] of which [f] holds, if there is one. The stem is a shortest one to the
    component that the cycle is in, and the cycle goes by the shortest way from one acceptance set to the next. [tick]
    is called once for each state of the product. *)
