(** The debug log of the network, the source ["dolphin.imc"] of {!Logs}: datagrams in and out, changes of vehicles,
    timers. Nothing is formatted unless the level is [Debug]. Times are seconds of the platform. *)

open Dolphin_semantics

val received : now:float -> from:Unix.inet_addr -> len:int -> Bytes.t -> unit
(** [received ~now ~from ~len buffer] logs the datagram that is the first [len] bytes of [buffer]. *)

val sent : now:float -> Unix.inet_addr -> int -> string -> unit
(** [sent ~now host port bytes] logs a datagram that leaves. *)

val unsent : now:float -> Unix.inet_addr -> int -> Unix.error -> unit
(** [unsent ~now host port error] logs that the system refused to send the last one, and why. *)

val changed : now:float -> Station.t -> Station.t -> unit
(** [changed ~now before after] logs what became different of vehicles: link, mode, readiness, plan. *)

val timer_set : now:float -> Residual.timer -> float -> unit
(** [timer_set ~now timer seconds] logs that [timer] is to fire after [seconds]. *)

val timer_cancelled : now:float -> Residual.timer -> unit
(** Logs that the timer is not to fire any more. *)

val event : now:float -> Dolphin_runtime.Platform.event -> unit
(** [event ~now e] logs the next event for the program: of a timer, that it fired. *)
