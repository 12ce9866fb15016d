(** Inline plans from the settings of [imcPlan { ... }]: [planName], [speed], [z], [locate], [move], and the maneuvers
    in the order in which they stand. Angles and positions are in degrees, lengths in metres, times in seconds. *)

open Core

val vocabulary : (string * string list) list
(** Every setting of a plan, with the names of its named arguments. *)

val build : name:string -> site -> setting list -> (Plan.t, Fault.t) result
(** [build ~name site settings] is the plan that [settings] (first one first) describe, called [name] unless
    [planName] says otherwise. A fault names what is unknown, of the wrong kind or out of range, and where. *)
