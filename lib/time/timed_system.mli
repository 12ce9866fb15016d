(** Runs with time as a transition system for {!Dolphin_checker.Breadth_first}: a state is a {!Timed.state} with a zone
    of its clocks. docs/time.md says why what is found is exact. *)

open Dolphin_semantics

(** What is asked: how late things may happen, or how early. Dates that do not matter to it are filled up, so that more
    states include each other. *)
type goal = Latest | Earliest

include Dolphin_checker.System.S with type via = unit and type property = unit

val create : goal -> Timed.options -> t

(** {1:dates Dates} *)

(** A date in milliseconds since the start. *)
type date = At of int | Unbounded

(** What happens to a task. *)
type moment = Starts | Ends | Fails | Stopped

type task = { name : string; vehicle : Core.vehicle; site : Core.site }

val tasks : t -> (task * (moment * date) list) list
(** When the tasks that run in some run do what, at the earliest or at the latest: by the order in which they were
    found. *)

(** How runs end. *)
type ending = Completed | Halted | Failed | Interrupted

val endings : t -> (ending * (date * int)) list
(** Likewise the ends of runs, with the number of the state there. *)

(** {1:forever Runs without end}

    Looked for with the goal [Latest]. *)

type cycle = {
  from : int;  (** the state from which the run goes round again and again *)
  last : int;  (** the state before it comes back *)
  back : Timed.step;  (** the step back *)
  in_no_time : bool;  (** whether no time need pass *)
}

val cycle : t -> cycle option
val stuck : t -> int option
(** The first state in which nothing happens any more although the run is not over. *)

val unknown : t -> Timed.pending list
(** What was awaited that takes some time, nobody knows how long: each once. *)

(** {1:runs Runs} *)

val run : t -> int -> Timed.step list
(** [run t n] is the steps of the run to state [n]. *)

val deadlines : t -> (Core.site * (date * Timed.step list) option) list
(** The [within] that begin in some run, by their places, each with when it is missed, at the earliest or at the latest,
    and a run until then; [None]: never. *)

val start : t -> Timed.state
