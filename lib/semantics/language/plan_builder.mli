(** Inline plans from the settings of [imcPlan { ... }]: [planName], [speed], [z], [locate], [move], and the maneuvers
    in the order in which they stand. Angles and positions are in degrees, lengths in metres, times in whole seconds.

    A plan begins with 900 RPM, at a depth of 2 m, and at the place that {!build} is given, if any. [locate], [move],
    [speed] and [z] change that for the maneuvers that follow; so do a maneuver's own arguments [location], [speed] and
    [z]. A maneuver without a place is a fault, except [popup], which is done where the vehicle is. A speed without a
    unit has that of the speed before it in the plan; the first is in metres per second. A [z] without a unit keeps the
    unit.

    A maneuver is called by its number and its IMC message, as in ["1.Goto"], unless it has an [id]. A duration of 0 is
    without end, as in IMC. *)

open Core

val vocabulary : (string * string list) list
(** Every setting of a plan, with the names of its named arguments. *)

val is_maneuver : string -> bool
(** Whether that setting is a maneuver. *)

val units : string list
(** The units of speeds and of [z], by their full names, as in ["Speed.Units.METERS_PS"]: the symbols that programs
    may use. {!build} takes also the last of the names, in a string of any case, as in [speed 1000, 'rpm']. *)

val no_place : string -> string
(** [no_place name] is the error of a plan whose setting [name] needs a place and has none. *)

val hint_for_place : string
(** How a plan gets a place. *)

val located : setting -> (Dolphin_geo.Position.t, Fault.t) result
(** The position after [locate]: of the settings of a plan, and of a program. *)

val build :
  name:string ->
  place:Dolphin_geo.Position.t option ->
  site ->
  setting list ->
  (Dolphin_plans.Plan.t, Fault.t) result
(** [build ~name ~place site settings] is the plan that [settings] (first one first) describe, called [name] unless
    [planName] gives another; it begins at [place] unless [settings] give a place. A fault names the value
    that is unknown, of the wrong kind or out of range, and its place: the setting, or [site] without any maneuver. *)
