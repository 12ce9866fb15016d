(** Dates for the steps of a run: all as late, or as early, as the run allows. *)

(** The cause of a date: the duration of an awaited event. *)
type link = {
  pending : Clocked.pending;
  at : Dolphin_semantics.Core.site option;  (** the place of a timer in the program *)
  from : int;  (** it began with this step, from 1; 0: at the start *)
  until : int;  (** and ended with this one, or would have *)
  lasts : int;  (** milliseconds *)
}

type t = {
  dates : int array;  (** of each step, in milliseconds since the start *)
  chain : link list;  (** the durations, one after the other, that add up to the last date *)
}

val make : Timed_system.goal -> Successors.t -> Clocked.state -> Clocked.step list -> t option
(** [make goal _ s steps] is the dates of the run [steps] from the initial state [s]. [None] if its end has no latest
    date. *)

val stretched : Successors.t -> Clocked.state -> Clocked.step list -> Dates.span list -> int array option
(** [stretched _ s steps spans] is dates of that run with [spans] between its steps, which are numbered from 1, as
    {!Dates.stretched} has them. *)

(** {1:bounds Bounds} *)

type walk
(** How far a run is, and with which step what is awaited began. *)

val set_out : Clocked.state -> walk
(** [set_out s] is a run that begins in [s], before its first step. *)

val walk : walk -> int -> Clocked.step -> walk
(** [walk w k s] is [w] after step [s], number [k] of the run. *)

val bounds : (Clocked.state -> Clocked.step list) -> walk -> int -> Clocked.step -> Clocked.pending Dates.bound list
(** [bounds steps w k s] is those of the date of [s], number [k] of a run that is as far as [w]; [steps] is the
    possible steps in a state. *)
