(** Reading the values of an inline plan's settings: each kind of value, its range and its faults. Lengths are in
    metres, angles in degrees, times in seconds. *)

open Core

(** {1:fault Faults} *)

val fault : setting -> ('a, Format.formatter, unit, ('b, Fault.t) result) format4 -> 'a
(** [fault s format ...] is an error with that text, at the site of [s]. *)

val wrong : setting -> string -> value -> ('a, Fault.t) result
(** [wrong s what x] is the error that [what] was expected and [x] found. *)

val instead : string -> string list -> otherwise:string -> string
(** [instead x xs ~otherwise] is the hint after a word [x] that is not among [xs]: the likely one, or [otherwise] and
    all of [xs]. *)

(** {1:read Readers} *)

type 'a reader = setting -> string -> value -> ('a, Fault.t) result
(** [read s what x] is the value of [x], or the reason why it is wrong. [s] is the setting that [x] belongs to, and
    [what] is the role of [x] there, such as ["radius of loiter"]. *)

val string : string reader
(** Not empty. *)

val boolean : bool reader
(** [true] or [false]. *)

val within : float -> float -> string -> float reader
(** [within from upto unit] reads numbers from [from] to [upto], both included. Faults have [unit] after the numbers,
    as in [" m"]; so in {!positive} and {!whole}. *)

val positive : float -> string -> float reader
(** [positive upto unit] reads numbers greater than 0 and at most [upto]. *)

val whole : float -> string -> float reader
(** [whole upto unit] reads whole numbers from 0 to [upto]; those that arithmetic has left next to one are it. *)

val longest : float
(** The longest of lengths. *)

val length : float reader
(** From 0 to {!longest}. *)

val radius : float reader
(** From 1 to {!longest}. *)

val seconds : float reader
(** A {!whole} number that IMC's durations can hold. *)

val percent : float reader
(** From 0 to 100, as plans count. [50.percent] is 0.5 in the language, so that numbers above 0 and at most 1 are
    faults. *)

val bearing : float reader
(** From -360 to 360 degrees; the result is at least 0 and less than 360. *)

val position : Dolphin_geo.Position.t reader
(** A position, or a list of latitude and longitude in degrees. *)

val coordinates : setting -> value -> value -> (Dolphin_geo.Position.t, Fault.t) result
(** [coordinates s latitude longitude] is the position there, at height 0. *)

(** {1:quantities Quantities with a unit} *)

val units : string list
(** The units of speeds and of z, by their full names, as in ["Speed.Units.METERS_PS"]. Read are also the last of the
    names, and strings in any case. *)

val speed :
  Dolphin_plans.Plan.speed_unit -> setting -> value list -> (float * Dolphin_plans.Plan.speed_unit, Fault.t) result
(** [speed default s xs] is the speed that [xs] are: a number and a unit, spread out or as one list. Without a unit, it
    has [default]. *)

val z : Dolphin_plans.Plan.z_unit -> setting -> value list -> (float * Dolphin_plans.Plan.z_unit, Fault.t) result
(** [z default s xs] is the z that [xs] are, as in {!speed}. *)

(** {1:payload Payload} *)

val devices : Dolphin_plans.Plan.payload list reader
(** Devices, as strings or as maps with a [name]; one alone, or a list. Names of devices and parameters are
    capitalised as DUNE has them, and a device is active by default. *)

(** {1:vehicles Vehicles} *)

val vehicle_names : setting -> (string list, Fault.t) result
(** [vehicle_names s] is the vehicles that the setting [vehicles] names, at least one, each once. *)
