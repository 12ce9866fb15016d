(** Missions from the settings of [mission { ... }]: [name] and [vehicles], and the items in the order in which they
    stand. Lengths are in metres, heights in metres above the home position, speeds in metres per second, times in
    seconds, angles and positions in degrees.

    Arguments stand in their order, or by name. A position may be latitude and longitude, spread out where it is the
    only argument, and a place north, east or up of a position: [goPos p, north: 10]. *)

open Core

val vocabulary : (string * string list) list
(** Every setting of a mission, with the names of its arguments. *)

val literal_fault : string -> (string option * value option) list -> string option
(** [literal_fault name arguments] is the fault of the setting [name] of [arguments], each with its name if it has
    one, for any values of those that are [None]: their number, their names, and the known values. *)

val build : name:string -> site -> setting list -> (Dolphin_plans.Mission_plan.t, Fault.t) result
(** [build ~name site settings] is the mission that [settings] (first one first) describe, called [name] unless it
    has a name. A fault names the value that is unknown, of the wrong kind or out of range, and its place. *)
