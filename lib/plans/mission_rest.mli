(** The rest of a mission that was cut. *)

val from_share : float -> from:Dolphin_geo.Position.t -> Mission_plan.t -> Mission_plan.t
(** [from_share x ~from m] is {!Inline_plan.from_share} of [m], whose way is that from [from]. *)
