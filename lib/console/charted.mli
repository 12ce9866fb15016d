(** What stands on a map of what a program says: the areas and positions that its global variables have, and the ways
    of plans that it describes. Pure; in JSON, with places as pairs of latitude and longitude. *)

open Dolphin_semantics

val places : Core.program -> Store.t -> Yojson.Safe.t
(** [places p s] is a list, in the order of the variables, those of lists one by one (at most 100 of each): each has a
    [name] and either [position], or [centre] and [radius] in metres, or [rings], the rims of an area and its holes. *)

val way : World.t -> Core.vehicle -> Core.platform_task -> Yojson.Safe.t option
(** [way world v task] is the way of the plan that [task] describes, from where [v] is in [world]: [vehicle], [plan],
    [path]; [None] if it describes none, or has no way. *)
