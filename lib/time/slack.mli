(** How much longer a task may take before the latest end of all runs is later. *)

type t =
  | Any  (** however long it takes *)
  | By of int  (** this number of milliseconds, and not one more *)

val of_task :
  latest:(Clocked.options -> Timed_system.date option) -> Clocked.options -> int -> Timed_system.task -> t option
(** [of_task ~latest o n task] is that of [task], in all its runs: of its longest duration in [o], whose runs are all
    over at [n]. [latest o'] is when the last run of [o'] is over; [None] if it is not found, and then the slack is
    [None]. *)
