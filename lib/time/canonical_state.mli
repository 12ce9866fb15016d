(** States of an executing task that are alike: equal but for names on which nothing depends (of vehicles, plans,
    timers, places in the text), the order of parallel parts, and the pairs of N that they name. docs/time.md shows
    why one of them is enough. *)

open Dolphin_semantics

type t

val create : ?apart:Core.vehicle -> Clocked.options -> t
(** [create ~apart o]: the tasks of [apart] are alike only among each other. *)

(** {1:executions Executions} *)

type label = { name : string; vehicle : Core.vehicle; site : Core.site }
(** A platform task. *)

type execution
(** A task as its execution begins, with its automorphisms. *)

val execution : tick:(unit -> unit) -> t -> Clocked.state -> execution option
(** [execution ~tick t s] is for the task that is about to be executed in [s]; [None] if it has no automorphism but the
    identity. [tick] is called for each of its parts, and may raise. *)

val orbit : execution -> label -> label list
(** [orbit e l] is the platform tasks that automorphisms make of [l], itself included. *)

val leaves_alike : t -> execution -> Clocked.state -> bool
(** [leaves_alike t e s] is whether automorphisms leave N as it is in [s], where the task is over: of those pairs
    that they rename into each other, it has none, or each equally often and without order. *)

(** {1:forms Forms} *)

type spelled
(** A state of an execution without names, but for the order of the parts that differ in names alone. *)

val spell : t -> execution -> Inert.item list -> Clocked.state -> spelled
(** [spell t e inert s] is for a state [s] of [e]. *)

val execution_of : spelled -> execution
(** The execution that {!spell} was given. *)

type form = {
  number : int;  (** states with the same one are alike *)
  items : Clocked.item list;  (** the awaited events, inert ends apart, in an order that alikeness keeps *)
}

val form : color:(Clocked.item -> int) -> colored:bool -> spelled -> form
(** [form ~color ~colored s] is that of a state. Among parts that differ in names alone, the order is by [color],
    which is part of the number if it is [colored]. *)
