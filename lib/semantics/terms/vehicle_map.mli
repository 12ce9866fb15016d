(** Finite maps from vehicles. *)

include Map.S with type key = Core.vehicle
