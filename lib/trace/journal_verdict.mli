(** Whether a journal is one of a run of a program. *)

open Dolphin_semantics

type t =
  | Run of { transitions : int; time : float; ending : Request.ending }  (** of a whole run *)
  | Prefix of { transitions : int; time : float; torn : bool  (** in the middle of a line *) }
  (** of the beginning of one: the console died *)
  | No_run of { number : int;  (** of the first line that is wrong *) entry : Entry.t; transitions : int;
                mismatch : Replay.mismatch }
  (** the [transitions] transitions before that line are the beginning of a run *)
  | Possible of { lines : int;  (** labels and events *) over : bool  (** with the end *) }
  (** a partial trace of a run of the program *)
  | Impossible of { number : int; entry : Entry.t; lines : int;  (** that were possible before *)
                    mismatch : Partial.mismatch }
  | Unknown of { number : int; most : int }
  (** a partial trace: up to this line there are more ways than could be gone through *)
  | Unreadable of { number : int; why : string }  (** this line is not a line of a journal *)

val check : ?world:World.t -> ?most:int -> Core.program -> hash:string -> Journal.t -> Header.t option * t
(** [check ~world ~most program ~hash reader] reads the journal to its end, or to its first fault; [hash] is that of
    the program's text, as in {!Header.source}. Places of transitions are only compared if the program is that of the
    journal. Of a partial trace, [world] is the vehicles known from the beginning (by default none), and at most
    [most] configurations, by default {!most}, are visited between two lines: see {!Partial}. *)

val most : int
(** 100,000. *)

val is_legal : t -> bool
(** Whether the journal is one of a run of the program, as far as it goes. *)

val pp : Format.formatter -> t -> unit
(** A sentence without a full stop, and for a trace that is not a run, further lines, for a vertical box. *)
