(** Readings: values of the semantics of open worlds. A reading stands for a sensor's value, where that may be
    anything. Code may pass it on, compute with it, compare it, and print it. A comparison with it may come out
    either way ({!World.claim}). Any other use of it is unclear, since its outcomes cannot be listed. *)

open Core

(** A sensor that a program looks at: its place, or another. *)
type subject = Position | Sensor of sensor

val subject : string -> subject option
(** [subject name] is the subject of the property or method [name] of a vehicle, if it is a sensor. *)

val look : World.t -> subject -> World.vehicle_state -> (value, World.question) result
(** [look w subject s] is the value of that sensor of [s]: if that may be anything, a reading whose text names the
    sensor; if the vehicle has not reported it, {!Core.Unknown}. *)

val now : World.t -> value
(** [now w] is the date: if that is open, a reading whose text is [now()]. *)

val time_of_day : begins:Calendar.t option -> World.t -> value option
(** [time_of_day ~begins w] is the time of day in seconds, if the date 0 is [begins]: if the date is open, a reading
    whose text is [timeOfDay()]; [None] if only [begins] is not known. *)

val is_reading : value -> bool
(** Whether it is a reading. *)

val keep : program -> Store.t -> Store.t
(** [keep p s] is [s] in which each reading is known by the variable that holds it. In the next step the sensor may show
    another value, and a kept reading must not be taken for that one. *)

val settled : site -> value -> (value, Fault.t) result
(** [settled at x] is [x]; if that is a reading, the fault that names the unclear value, at [at]. *)

(** The result of an operation for arguments some of which are readings. *)
type applied =
  | Gives of (value, string) result
  | Asks of World.question
  | Unclear of Fault.t
  | As_any  (** the operation treats readings as it does any values *)

val apply : begins:Calendar.t option -> World.t -> site -> operation -> value list -> applied
(** [apply ~begins w at o xs] is the result of [o], which stands at [at], for [xs] in the world [w], if the date 0 is
    [begins]. *)
