(** A run with dates, as a journal has it, compared with the bounds on its tasks and timers. Other modules check that
    it is a run at all. *)

open Dolphin_semantics

type t

(** Something that ended before it could, or went on for longer than it may. *)
type finding = {
  pending : Clocked.pending;
  at : Core.site option;  (** the place of a timer in the program *)
  began : int;  (** milliseconds since the start *)
  seen : int;  (** when it ended, or when it should have *)
  too_early : bool;
}

val start : tolerance:int -> Clocked.options -> t
(** [start ~tolerance o] is before the first transition. Differences up to this number of milliseconds do not count:
    links and clocks are not exact. *)

val onwards :
  t -> outside:Dolphin_environment.Environment.t -> date:int -> seen:(Core.vehicle * Dolphin_geo.Position.t) list ->
  Clocked.options * Clocked.state
(** [onwards r ~outside ~date ~seen] is {!Clocked.onwards} from [date] after [r], and the options of [r]: vehicles
    neither join nor leave by the fleet any more. *)

val running : t -> (Clocked.pending * int) list
(** [running r] is the tasks that vehicles carry out after [r], each with when it began, in milliseconds since the
    start. *)

val with_tolerance : int -> t -> t
(** [with_tolerance ms r] is [r], with this one from now on. *)

val heard : t -> date:int -> Core.vehicle -> bool -> t
(** [heard r ~date v connected] is [r] after the news whether there is a link to [v]. Events without a link are
    reported when it is back: tasks may end later by that much, and tasks whose order waited for it begin then. *)

val transition : t -> date:int -> on:Transition.event option -> Transition.t -> t * finding list
(** [transition r ~date ~on t] is [r] after [t], on the event [on], [date] milliseconds after the start; and its
    faults, each once. Tasks must end within their bounds, and fail by their end; if the link was lost, by any time.
    Timers expire when they are due. *)
