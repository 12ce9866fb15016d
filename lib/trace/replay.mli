(** Journals, judged by the semantics: a journal is one of a run if each of its transitions is what
    {!Dolphin_semantics.Transition} makes of the configuration before it, of what was known of vehicles, and of the
    event before it. Nothing is kept of lines but the configuration that they lead to. *)

open Dolphin_semantics

type t

val start : hash:string -> Core.program -> t
(** [start ~hash program] is before the first line; [hash] is that of the program's text, as in {!Header.source}. Where
    a journal's header, or the line of its latest resumption, has another one, it does not matter where transitions are
    said to be in the program: after it was changed, they are elsewhere. *)

(** Why a line is none of a run. *)
type mismatch = {
  reason : string;  (** a sentence without a full stop *)
  false_guards : (Dolphin_syntax.Location.t * string) list;
  (** the conditions that the task waits for and that are false, by place and kind *)
  enabled : string list;  (** labels of what the program could do by itself; the first ones if there are many *)
  awaited : string list;  (** the events that it waited for *)
}

val feed : t -> Entry.t -> (t, mismatch) result
(** [feed r line] is [r] after [line]. *)

val latest : t -> (Transition.event option * Transition.t) option
(** The transition of the latest line, with what caused it; [None] if that line was no transition. *)

val event : t -> Transition.event option
(** What the latest line told of, if the transition that it causes is still to come. *)

val configuration : t -> Configuration.t
(** After the latest transition. *)

val world : t -> World.t
(** What was known of vehicles. *)

val transitions : t -> int
(** How many there were. *)

val time : t -> float
(** Of the latest line. *)

val was_stuck : t -> bool
(** The latest transition interrupted a run in which nothing could happen any more. *)

val ending : t -> Request.ending option
(** How the run ended, if its last line was there. *)

val pp_mismatch : Format.formatter -> mismatch -> unit
(** The reason, and further lines, for a vertical box. *)
