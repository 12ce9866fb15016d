(** All runs of a small program, second by second: the untimed transition function with a count of seconds for
    everything that is awaited. What {!Dolphin_time} finds must be this. All bounds are whole seconds, so the earliest
    and the latest dates are reached by runs in which everything happens at whole seconds. *)

open Dolphin_time

type moment = Ended of Timed_system.ending | Task of Timing.task * Timed_system.moment

type t = {
  dates : (moment * (int * int)) list;  (** the earliest and the latest second *)
  never_over : bool;  (** some run gets stuck, or goes round for ever in no time *)
}

val all : ?states:int -> ?seconds:int -> Timed.options -> t option
(** [None] if there are more states, or longer runs, than that. *)
