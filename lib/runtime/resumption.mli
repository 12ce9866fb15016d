(** The journal of a run whose console died, read in order to resume the run. *)

open Dolphin_semantics
open Dolphin_trace

type t = {
  header : Header.t;
  replay : Replay.t;  (** after the last line that counts *)
  history : History.t;  (** up to there, and [pending] *)
  pending : Transition.event option;
  (** The journal has this event, and not the transition that it causes: the event is to be handled again, and its line
      does not count. *)
  interrupted : bool;  (** [pending] is an interruption that was asked for, not that of a program that is stuck *)
  clock : float * string;  (** a time of the run, and when that was, in UTC: when it began, or was resumed last *)
  kept : int;  (** the number of bytes of the journal that count; the rest is torn, or [pending]'s line *)
  notes : int;  (** the [platform] lines among them *)
}

(** Why there is nothing to resume. *)
type trouble =
  | Over of Request.ending  (** the run ended *)
  | Changed  (** the program is not the one that ran *)
  | No_run of Journal_verdict.t  (** the journal is not one of a run of the program, or not a journal *)

val read :
  ?tell:(Entry.t -> Replay.t -> unit) ->
  ?changed:bool ->
  Core.program ->
  hash:string ->
  Journal.t ->
  (t, trouble) result
(** [read ~tell ~changed program ~hash reader] goes through the journal with the transition function; [hash] is that
    of the program's text. [tell] gets each line that counts, in order, with the replay after it. With
    [~changed:true] (by default false) the hash may differ, as long as the journal is one of a run of [program]. *)

val seen : t -> (float * World.vehicle_state) list
(** The journal's last line on each vehicle, with its time. *)

val pp_trouble : Format.formatter -> trouble -> unit
(** A sentence without a full stop, and perhaps further lines, for a vertical box. *)
