(** The unasked reports of a vehicle about itself. *)

open Dolphin_imc

val announce :
  name:string ->
  kind:string ->
  id:int ->
  Dolphin_geo.Position.t ->
  Address.t list ->
  Message.Announce.t
(** [announce ~name ~kind ~id position addresses], with services for each of [addresses], in the style of DUNE. *)

val estimated_state :
  reference:Dolphin_geo.Position.t ->
  Dolphin_geo.Position.t ->
  course:float ->
  speed:float ->
  Message.Estimated_state.t
(** [estimated_state ~reference position ~course ~speed]: latitude and longitude are those of [reference], the
    offsets lead from there to [position]. [course] is in degrees. Sea and ground are at height 0; an altitude is
    reported above it only. *)

val fuel_level : float -> Message.Fuel_level.t
(** [fuel_level share] of a battery that is charged to [share], from 0 to 1. *)

val entities : string list -> string
(** [entities payload] is the entities of a vehicle, as in EntityList: those that every vehicle has, and the devices
    [payload]. *)
