(** All runs of a small program, second by second: the untimed transition function with a count of seconds for
    everything that is awaited. The results of {!Dolphin_time} must be these. All bounds are whole seconds, so the
    earliest and the latest dates are reached by runs in which everything happens at whole seconds. *)

open Dolphin_semantics
open Dolphin_time

type moment = Ended of Timed_system.ending | Task of Timed_analysis.task * Timed_system.moment

type t = {
  dates : (moment * (int * int)) list;  (** the earliest and the latest second *)
  never_over : bool;  (** some run gets stuck, or repeats without end in no time, while sensors show one thing *)
  most : (Core.vehicle * int) list;
  (** the most that is missing at any time in the battery of a vehicle that works in some run *)
}

(** The missing charge of a battery, in parts. *)
type battery = {
  at_first : int;
  work : int;  (** the parts that a second of it takes *)
  rest : int;  (** the parts that a second of it gives, until none is missing; or takes, if less than 0 *)
  charges : (string * int) list;  (** plans of which a second gives these parts, instead of taking [work] *)
}

val all :
  ?states:int -> ?seconds:int -> ?batteries:(Core.vehicle * battery) list ->
  ?seen:(Core.vehicle -> int -> World.t -> World.t) -> ?look:(Configuration.t -> unit) -> Clocked.options -> t option
(** [look] is called with each configuration that a run comes to. [None] if there are more states, or longer runs,
    than that, or if the outcomes of a step cannot be listed. [most] is of [batteries]: states differ in the missing
    charge, and the program looks at the world that [seen] makes of this, by default the same always. *)
