(** What a sensor shows that may show anything, as a value. It may be handed on, computed with, compared and told of:
    of a comparison both outcomes are possible ({!World.claim}). Of whatever else could be done with it nobody could
    list the outcomes: {!Unsettled}. Only open worlds have such values. *)

open Core

exception Unsettled of Fault.t
(** Raised by the transition function in an open world: the outcome of a step depends on a reading, and not by a
    comparison alone. The fault says where, and what to do. *)

val battery : World.t -> World.vehicle_state -> value
(** What the battery shows, or in a world where that is open, a reading that spells it. *)

val position : World.t -> World.vehicle_state -> value
(** Likewise where it is seen. *)

val is_reading : value -> bool
(** Whether its value is open. *)

val keep : program -> Store.t -> Store.t
(** [keep p s] is [s], in which each reading is known by the variable that holds it. In the next step the sensor may
    show something else, so what it showed then must not be taken for what it shows now. *)

val settled : site -> value -> value
(** [settled at x] is [x].
    @raise Unsettled if [x] is a reading. *)

val apply : World.t -> site -> operation -> value list -> (value, string) result option
(** [apply w at o xs] is what [o] makes of [xs], some of which are readings; [None] if it is what [o] makes of any
    values.
    @raise Unsettled if there is no telling. *)
