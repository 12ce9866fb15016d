(** Finite sets of vehicles. *)

include Set.S with type elt = Core.vehicle
