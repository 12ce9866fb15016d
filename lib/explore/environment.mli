(** The outside of an explored program: what may happen to a configuration besides its own steps. Everything that
    [Transition] offers may happen in any order, restricted as {!options} say. Sensors do not change: code that reads
    positions and batteries always sees the world as it is given. *)

open Dolphin_semantics

(** How a platform task may end. *)
type endings = Succeeds | May_fail | Fails

type options = {
  endings : Core.vehicle -> string -> endings;  (** of a vehicle's run of the plan with this name *)
  failures : int option;  (** at most so many of those that need not be in one run; [None]: no bound *)
  answers : string -> string list list;
  (** by prompt, for the first time it is asked, the second and so on: what may be answered then. The last item is for
      all later times. Where there is none, nobody answers. *)
}

val default : options
(** Tasks succeed, nobody answers. *)

val failing : ?failures:int -> options -> options
(** [failing options] is [options] with every task that may succeed failing too, at most [failures] times. *)

type t
(** What the outside remembers. *)

val initial : t
val compare : t -> t -> int
val hash : t -> int

val task_ends : options -> t -> Core.vehicle -> Core.platform_task -> (Transition.event * t) list
(** [task_ends o e v p] is the events that may end [p] on [v]. *)

val choices : options -> Core.program -> World.t -> t -> Configuration.t -> (Transition.t * t) list
(** [choices o p w e c] is every transition of [c]: its own, leftmost first, then those on events, in the order of
    [Transition.awaited]. A call of the host fails: there is none to explore. *)
