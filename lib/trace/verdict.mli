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
  (** a partial trace of what the program can do *)
  | Impossible of { number : int; entry : Entry.t; lines : int;  (** that were possible before *)
                    mismatch : Partial.mismatch }
  | Unknown of { number : int; most : int }
  (** a partial trace: up to this line there are more ways than could be gone through *)
  | Unreadable of { number : int; why : string }  (** this line is no line of a journal *)

val check : ?world:World.t -> ?most:int -> Core.program -> hash:string -> Journal.t -> Header.t option * t
(** [check ~world ~most program ~hash reader] reads the journal to its end, or to what is wrong with it; [hash] is that
    of the program's text, as in {!Header.source}. Where transitions are in the program only matters if the program is
    that of the journal. Of a partial trace, [world] is what is known of vehicles from the beginning (by default
    nothing), and at most [most] configurations, by default {!most}, are visited between two lines: see {!Partial}. *)

val most : int
(** 100,000. *)

val is_legal : t -> bool
(** Whether the journal is one of a run of the program, as far as it goes. *)

val pp : Format.formatter -> t -> unit
(** A sentence without a full stop, and for what is no run, further lines, for a vertical box. *)
