(** An adapter as a process: started, greeted, written to and read. *)

open Dolphin_platform_protocol

module Order := Dolphin_platform_protocol.Order

type t

val start : command:string -> Order.t -> (t * Report.greeting, string) result Lwt.t
(** [start ~command hello] starts [command], for [/bin/sh], and greets it. The error is the reason why the greeting
    has no reply, as a predicate: ["ended with exit status 127"]. If it is cancelled, the process is ended. *)

val send : t -> string -> unit
(** [send a line] writes [line] when the adapter reads; never waits. *)

(** The output of an adapter. *)
type line = Report of Report.t | Garbage of string  (** its fault: ["is not JSON: ..."] *)

val listen : t -> (line -> unit) -> string Lwt.t
(** [listen a f] gives [f] each line, in order, and resolves at the end of the output: with the reason, as a
    predicate. *)

val close : t -> unit Lwt.t
(** Ends it, by force if need be. *)

val greeting_patience : float
(** 10 s *)
