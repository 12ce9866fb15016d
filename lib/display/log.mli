(** The log of a run, for people: time, subject, event.

    {v
  0:00  program     picks noptilus-1, noptilus-2, noptilus-3
  0:00  noptilus-1  starts survey1
  6:12  noptilus-1  ends survey1
  6:12  program     posts ready:1
    v} *)

open Dolphin_semantics

type t
(** The part of the run that the log remembers. *)

val start : t
(** Before the first line. *)

(** {1 Lines} *)

(** How important a line is to a reader. *)
type severity =
  | Trouble  (** a failure, a lost link, the end of a run that did not complete *)
  | Said  (** a message of the program *)
  | Completed  (** that the run did *)
  | Ordinary

(** A line of the log. *)
type line = {
  about : Core.vehicle list;  (** its vehicles *)
  severity : severity;
  text : string;  (** which may have several lines *)
}

val is_shown : quiet:bool -> only:Core.vehicle list -> line -> bool
(** [is_shown ~quiet ~only l] is whether [l] stays if only trouble and the program's messages are wanted ([quiet]),
    and only lines about the vehicles [only], unless that is [[]]. Trouble and the end always stay. *)

val tint : colour:bool -> line -> string
(** Its text, coloured by its severity if [colour]. *)

val transition : ?stuck:bool -> t -> time:float -> Transition.t -> t * line list
(** [transition l ~time s] is the lines for [s], in the order of its effects, and the log after it. Silent steps have
    no line, nor has the question of an [ask], which {!question} reports. Pairs that the end of a task posts by [ensure]
    have one. With [~stuck:true] an interruption is reported as the end of a stuck program, not as a person's wish. *)

val news : t -> time:float -> World.vehicle_state -> t * line list
(** [news l ~time state] is the lines for vehicles of the program that lose their link or have it back. *)

val question : t -> time:float -> string -> string
(** [question l ~time prompt] is the line that asks [prompt]; the answer is to follow it. *)

val remark : t -> time:float -> string -> line
(** [remark l ~time text] is a line about an unusual event. *)

val words : Transition.t -> string
(** [words t] is the log's words for the deed, guard or timer that made [t]; [""] for other transitions. *)
