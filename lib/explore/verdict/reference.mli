(** The state graph by the book: breadth first over configurations in a hash table. Slow, and plain enough to be read;
    {!Search} must agree with it. *)

open Dolphin_semantics
open Dolphin_environment

(** A state: its configuration, and the environment's memory. *)
type state = { configuration : Configuration.t; outside : Environment.t }

type t = {
  options : Environment.options;
  program : Core.program;
  states : state array;  (** breadth first; the initial one is number 0 *)
  edges : (Transition.t * int) list array;  (** by state: its transitions, in order, with the state each leads to *)
  depths : int array;  (** by state: the fewest transitions that lead there *)
}

val explore :
  ?limit:int -> ?start:Configuration.t * Environment.t -> Environment.options -> Core.program -> World.t -> t option
(** [explore ~start o p w] is the whole graph of the states reachable from [start], by default from the beginning of
    the program, or [None] if it has more than [limit] states, 100,000 by default. *)

val transitions : t -> int
(** The number of transitions. *)

val depth : t -> int
(** The most transitions of a shortest run to a state. *)

val goes_round : t -> bool
(** Whether some cycle stays within a task, made by a [repeat] without a number of rounds: fairness decides whether
    it violates termination. *)

val broken : t -> (Property.t * int) list
(** The properties of {!Property.all} that are broken, except [All_reached]: each with the fewest transitions after
    which this shows. [Termination] shows where a state is met again. *)
