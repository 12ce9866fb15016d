(** Formulas that tell the blocks of a refinement apart. *)

val formula : Graph.t -> Refinement.t -> int -> int -> Formula.t
(** [formula g r b c], where [r] is a refinement of [g] that was run and did not count, holds in the states of block
    [b] and not in those of block [c], which is another. It is of least depth. *)
