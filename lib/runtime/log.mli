(** The debug log of the runtime, the source ["dolphin.runtime"] of {!Logs}: the events from outside, the transitions
    that followed, and their effects. Nothing is formatted unless the level is [Debug]. *)

open Dolphin_semantics

val transition : time:float -> cause:Transition.event option -> Transition.t -> unit
(** [transition ~time ~cause t] logs that [t] was taken at [time] (s, the platform's), on the event [cause] or by
    itself, and its effects. *)

val not_awaited : time:float -> Transition.event -> unit
(** [not_awaited ~time e] logs that nothing in the program waits for [e]. *)

val vehicle : time:float -> World.vehicle_state -> unit
(** [vehicle ~time state] logs news of a vehicle. *)
