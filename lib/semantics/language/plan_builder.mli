(** Inline plans from the settings of [imcPlan { ... }]: [planName], [speed], [z], [locate], [move], and the maneuvers
    in the order in which they stand. Angles and positions are in degrees, lengths in metres, times in whole seconds.

    A plan begins at [Location.APDL], with 900 RPM, at a depth of 2 m. [locate], [move], [speed] and [z] change that for
    the maneuvers that follow; so do a maneuver's own arguments [location], [speed] and [z]. A speed without a unit has
    that of the speed before it in the plan; the first is in metres per second. A [z] without a unit keeps the unit.

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

val build : name:string -> site -> setting list -> (Plan.t, Fault.t) result
(** [build ~name site settings] is the plan that [settings] (first one first) describe, called [name] unless
    [planName] gives another. A fault names the value that is unknown, of the wrong kind or out of range, and its
    place: the setting, or [site] without any maneuver. *)
