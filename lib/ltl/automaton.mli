(** Generalised Büchi automata of formulas, by the tableau of Gerth, Peled, Vardi and Wolper (1995). A letter is the
    propositions that hold at a position, as a function. A run takes at each position a state that {!admits} the
    letter there: at the first one of {!initial}, afterwards a successor. It is accepting if for each acceptance set
    it is in that set again and again; a word without end satisfies the formula exactly if there is such a run. *)

type 'p t

val of_formula : 'p Formula.t -> 'p t
(** Propositions are compared by the polymorphic order. Exponential in the formula at worst. *)

val states : 'p t -> int
val initial : 'p t -> int list
val successors : 'p t -> int -> int list

val admits : 'p t -> int -> ('p -> bool) -> bool
(** [admits a q letter] is whether [a] may be in [q] where [letter] is read. *)

val is_open : 'p t -> int -> bool
(** [is_open a q] is whether nothing is left to be shown in [q]: every word that goes on from there is accepted. *)

val acceptance_sets : 'p t -> int
val is_in : 'p t -> int -> int -> bool
(** [is_in a q i] is whether [q] is in acceptance set [i], from 0. *)
