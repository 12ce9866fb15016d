(** Generalised Büchi automata of formulas, by the tableau of Gerth, Peled, Vardi and Wolper (1995). A letter is the
    propositions that hold at a position, as a function. A run takes at each position a state that {!admits} the
    letter there: at the first one of {!initial}, afterwards a successor. It is accepting if for each acceptance set
    it is in that set again and again; a word without end satisfies the formula exactly if there is such a run. *)

type 'p t

val of_formula : 'p Formula.t -> 'p t
(** Propositions are compared by the polymorphic order. Exponential in the formula at worst. *)

val states : 'p t -> int
(** The number of states; they are numbered from 0. *)

val initial : 'p t -> int list
(** The states in which a run may be at its first position. *)

val successors : 'p t -> int -> int list
(** [successors a q] is the states in which a run may be at the position after [q]. *)

val admits : 'p t -> int -> ('p -> bool) -> bool
(** [admits a q letter] is whether [a] may be in [q] where [letter] is read. *)

val is_open : 'p t -> int -> bool
(** [is_open a q] is whether nothing is left to be shown in [q]: every word that goes on from there is accepted. *)

val acceptance_sets : 'p t -> int
(** The number of acceptance sets, numbered from 0; none if every run is accepting. *)

val is_in : 'p t -> int -> int -> bool
(** [is_in a q i] is whether [q] is in acceptance set [i], from 0. *)
