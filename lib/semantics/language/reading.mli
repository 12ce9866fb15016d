(** What a sensor shows that may show anything, as a value. It may be handed on, computed with, compared and told of:
    of a comparison both outcomes are possible ({!World.claim}). Of whatever else could be done with it nobody could
    list the outcomes: that is unclear. Only open worlds have such values. *)

open Core

type sensor = Battery | Position

val sensor : string -> sensor option
(** [sensor name] is the sensor that the property or method [name] of a vehicle looks at, if it is one. *)

val look : World.t -> sensor -> World.vehicle_state -> (value, World.question) result
(** [look w sensor s] is what the sensor of [s] shows; a reading that spells it, if that may be anything. *)

val is_reading : value -> bool
(** Whether its value is open. *)

val keep : program -> Store.t -> Store.t
(** [keep p s] is [s], in which each reading is known by the variable that holds it. In the next step the sensor may
    show something else, so what it showed then must not be taken for what it shows now. *)

val settled : site -> value -> (value, Fault.t) result
(** [settled at x] is [x], unless it is a reading: then what is unclear, at [at]. *)

(** What an operation makes of arguments some of which are readings. *)
type applied =
  | Gives of (value, string) result
  | Asks of World.question
  | Unclear of Fault.t
  | As_any  (** what it makes of any values *)

val apply : World.t -> site -> operation -> value list -> applied
