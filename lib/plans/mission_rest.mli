(** The rest of a mission that was cut. *)

val from_share : float -> Mission_plan.t -> Mission_plan.t
(** [from_share x m] is {!Inline_plan.from_share} of [m], whose way is fixed. *)
