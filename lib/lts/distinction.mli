(** Formulas that distinguish the blocks of a refinement. *)

val formula : Graph.t -> Refinement.t -> int -> int -> Modal_formula.t
(** [formula g r b c], where [r] is a refinement of [g] that was run and did not count, holds in the states of block
    [b] and not in those of another block [c]. It is of least depth. *)
