(** The records of a run while it lasts: its journal, its picture, and any other follower of its lines. *)

open Dolphin_trace

(** The records to be made; [None]: not this one. *)
type settings = {
  journal : string option;  (** a file *)
  drawing : Drawing.t option;
  follower : (Entry.t -> unit) option;  (** is given each line of the journal, once it is written *)
}

val nothing : settings
(** Nothing is kept. *)

val is_wanted : settings -> bool
(** Whether anything is kept. *)

val utc_now : unit -> string
(** The time now, as headers and resumptions have it: ["2026-03-01T12:00:00Z"]. *)

type t

exception Broken of string
(** The journal cannot be written any more: why, in a sentence without a full stop. *)

val start : settings -> Header.t -> Dolphin_semantics.Core.program -> (t, Error.t) result
(** [start s header program] opens the journal's file, which stays as it is until {!begin_}. The error gives the
    reason: it would overwrite the program or the fleet, or the journal of a run that broke off, or another console
    writes it. *)

val resume : settings -> Dolphin_semantics.Core.program -> source:Header.source -> Resumed.t -> (t, Error.t) result
(** [resume s program ~source run] opens the journal that goes on with [run]: its own file, or if [s] names another one,
    a copy. [source] is the program's file. It fails as {!start} does. *)

val begin_ : t -> (unit, Error.t) result
(** [begin_ r] begins the journal, if nothing of it has been written yet: with its header, or where it broke off. The
    error, {!Error.Unavailable}, gives the reason why it cannot be written. *)

val note : t -> time:float -> vehicle:string -> Yojson.Safe.t -> unit
(** [note r ~time ~vehicle json] keeps what the platform wants to find again of a vehicle. It may raise {!Broken}. *)

val act : t -> time:float -> Act.t -> (unit, string) result
(** [act r ~time a] keeps the act of an operator, unless {!finish} was called. The error is the reason why it cannot be
    written. *)

val replace :
  t -> time:float -> Dolphin_semantics.Core.program -> source:Header.source -> Replay.t -> unit
(** [replace r ~time program ~source replay] keeps that the run goes on with [program], whose file is [source] and which
    [replay] has taken through the journal so far. It may raise {!Broken}. *)

val sync : t -> (unit -> unit Lwt.t) option
(** Resolves once all earlier lines are on the disk, and may fail with {!Broken}; [None]: no journal is kept. *)

val journal : t -> string option
(** The path of the journal, if there is one. *)

val observer : ?unasked:(unit -> bool) -> t -> Dolphin_runtime.Observer.t
(** The observer that writes the journal; it comes before others and may raise {!Broken}. [unasked] is as of
    {!Recorder.transition}. *)

val close : t -> unit
(** [close r] gives the journal's file up, as it is; if the file is new and the journal was not begun, it is removed.
    It may be called again, and after {!finish}. *)

val finish : t -> time:float -> stuck:bool -> (unit, Error.t) result
(** [finish r ~time ~stuck] ends the journal of a run that is over, and draws it. The error, {!Error.Unavailable},
    names the output that could not be written. *)
