(** The sensors of a fleet's vehicles, as an analysis of all runs takes them: docs/explorer.md, "Sensors". *)

open Dolphin_semantics

val of_vehicle :
  Core.vehicle -> places:Dolphin_geo.Position.t list -> batteries:float list -> World.t -> World.t
(** [of_vehicle v ~places ~batteries w] is [w] in which the place, battery, speed and link of [v] are open, with these
    values or, where there are none, with any. *)

val of_entry : World.t -> Entry.vehicle -> World.t
(** [of_entry w v] is [w] in which the sensors of [v] are open, with the values that its entry lists. *)
