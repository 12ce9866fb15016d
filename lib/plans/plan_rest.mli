(** The rest of a plan of maneuvers that was cut. *)

val from_share : float -> Plan.t -> Plan.t
(** [from_share x p] is {!Inline_plan.from_share} of [p]. *)
