(** Runs of a graph whose letters satisfy a formula: the product of the graph with the formula's automaton, searched for
    strongly connected components that meet all acceptance sets. Takes no stack. It is plain, and some words a state:
    the explorer has the same from {!Monitor} and {!Cycles} for a few bytes, and is compared with this. *)

(** A graph: a letter stands at each arrival in a state. *)
type 'letter graph = {
  start : int * 'letter;  (** the first state and its letter *)
  successors : int -> (int * 'letter) list;
  (** states and the letters with which they are arrived at; a state without any would be the end of the run: let
      it succeed itself *)
}

(** States with the letters they are arrived at with. *)
type 'letter lasso = {
  stem : (int * 'letter) list;  (** from the start; not empty *)
  cycle : (int * 'letter) list;  (** repeated for ever after the stem; its last state is that of the stem. Not empty *)
}

val satisfying :
  ?tick:(unit -> unit) -> holds:('letter -> 'p -> bool) -> 'letter graph -> 'p Formula.t -> 'letter lasso option
(** [satisfying ~holds g f] is a run of [g] of which [f] holds, if there is one. The stem is a shortest one to the
    component that the cycle is in, and the cycle goes by the shortest way from one acceptance set to the next. [tick]
    is called once for each state of the product. *)
