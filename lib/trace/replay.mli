(** Journals, checked by the semantics: a journal is that of a run if each of its transitions is the one that
    {!Dolphin_semantics.Transition} gives for the configuration before it, the known vehicles, and the event before
    it. Of the lines only the configuration that they lead to is kept. *)

open Dolphin_semantics

type t

val start : hash:string -> Core.program -> t
(** [start ~hash program] is before the first line; [hash] is that of the program's text, as in {!Header.source}. If
    a journal's header, or the line of its latest resumption, has another hash, the places of transitions are not
    compared: in a program that was changed they are elsewhere. If [program] has no place for its plans, they have that
    of the header. *)

(** Why no run has this line. *)
type mismatch = {
  reason : string;  (** a sentence without a full stop *)
  false_guards : (Dolphin_syntax.Location.t * string) list;
  (** the conditions that the task waits for and that are false, by place and kind *)
  enabled : string list;  (** labels of the steps that the program could take by itself; the first ones of a long
                              list *)
  awaited : string list;  (** the events that it waited for *)
}

val feed : t -> Entry.t -> (t, mismatch) result
(** [feed r line] is [r] after [line]. *)

val latest : t -> (Transition.event option * Transition.t) option
(** The transition of the latest line, with its cause; [None] if that line was not a transition. *)

val event : t -> Transition.event option
(** The event of the latest line, if the transition that it causes is still to come. *)

val configuration : t -> Configuration.t
(** After the latest transition. *)

val world : t -> World.t
(** The known vehicles. *)

val transitions : t -> int
(** How many there were. *)

val time : t -> float
(** Of the latest line. *)

val was_stuck : t -> bool
(** The program was interrupted because it was stuck. *)

val stuck_in : t -> Residual.t option
(** The place where it was stuck, if so. *)

val ending : t -> Request.ending option
(** How the run ended, if its last line was there. *)

val pp_mismatch : Format.formatter -> mismatch -> unit
(** The reason, and further lines, for a vertical box. *)
