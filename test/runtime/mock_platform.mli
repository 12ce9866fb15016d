(** A platform in memory, scripted: events are due at given times, vehicles run their tasks, commands are logged. *)

open Dolphin_semantics
open Dolphin_runtime

(** The outcome of a task that a vehicle starts. *)
type fate = Succeeds of float  (** after this number of seconds *) | Fails of float * string | Goes_on

type t

val make : ?fate:(Core.vehicle -> string -> fate) -> (float * Platform.event) list -> t
(** [make ~fate events] has [events] at their times. [fate v plan] is by default [Succeeds 10.]. *)

val vehicle : ?kind:string -> ?battery:float -> ?connected:bool -> string -> World.vehicle_state
val silent : float -> string -> float * Platform.event
(** [silent time id] is as {!seen}, of a vehicle that has not reported its battery. *)

val seen : ?battery:float -> float -> string -> float * Platform.event

val fail_on_start : t -> unit
(** Every [start] raises [Failure "no link"] from now on. *)

val log : t -> string list
(** The requests to the platform so far, as ["TIME COMMAND"]; binding and releasing, starting and stopping,
    telemetry, closing, connection timeouts. *)

(** Its time passes inside of [next]. *)
module Virtual : Platform.S with type t = t

(** The same, but claims that its time passes by itself: each event takes a turn of the event loop. *)
module Paced : Platform.S with type t = t
