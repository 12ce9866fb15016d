(** All runs of a small program, second by second: the untimed transition function with a count of seconds for
    everything that is awaited. What {!Dolphin_time} finds must be this. All bounds are whole seconds, so the earliest
    and the latest dates are reached by runs in which everything happens at whole seconds. *)

open Dolphin_semantics
open Dolphin_time

type moment = Ended of Timed_system.ending | Task of Timing.task * Timed_system.moment

type t = {
  dates : (moment * (int * int)) list;  (** the earliest and the latest second *)
  never_over : bool;  (** some run gets stuck, or goes round for ever in no time *)
  most : (Core.vehicle * int) list;
  (** the most that a run needs of the battery of a vehicle that works in some run: of a quarter of what a second of
      work takes, four a second of work, and one a second of rest *)
}

val all :
  ?states:int -> ?seconds:int -> ?working:bool -> ?look:(Configuration.t -> unit) -> Timed.options -> t option
(** [look] is called with each configuration that a run comes to. [None] if there are more states, or longer runs, than
    that. [most] is empty unless [working] is true; then states differ in how long vehicles worked. *)
