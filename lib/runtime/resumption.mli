(** The journal of a run whose console died, read to be gone on with. *)

open Dolphin_semantics
open Dolphin_trace

type t = {
  header : Header.t;
  replay : Replay.t;  (** after the last line that is gone on with *)
  history : History.t;  (** up to there, in order; and [pending] *)
  pending : Transition.event option;
  (** The journal tells of this, and not of the transition that it causes: the event is to be dealt with again, and its
      line is none of those that are gone on with. *)
  clock : float * string;  (** a time of the run, and when that was, in UTC: when it began, or was resumed last *)
  kept : int;  (** so many bytes of the journal are gone on with; what follows them is torn, or [pending]'s line *)
}

(** Why there is nothing to resume. *)
type trouble =
  | Over of Request.ending  (** the run ended *)
  | Changed  (** the program is not the one that ran *)
  | No_run of Verdict.t  (** the journal is none of a run of the program, or none at all *)

val read :
  ?tell:(Entry.t -> Replay.t -> unit) -> ?changed:bool -> Core.program -> hash:string -> Journal.t -> (t, trouble) result
(** [read ~tell ~changed program ~hash reader] goes through the journal with the transition function; [hash] is that of
    the program's text. [tell] is told of each line that is gone on with, in order, with what it led to. With
    [~changed:true] (by default false) it is enough that the journal is one of a run of [program]. *)

val seen : t -> (float * World.vehicle_state) list
(** What the journal says of each vehicle, and when it said so. *)

val pp_trouble : Format.formatter -> trouble -> unit
(** A sentence without a full stop, and perhaps further lines, for a vertical box. *)
