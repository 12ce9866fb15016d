(** The log of a run, for people: when, who, what.

    {v
  0:00  program     picks noptilus-1, noptilus-2, noptilus-3
  0:00  noptilus-1  starts survey1
  6:12  noptilus-1  ends survey1
  6:12  program     posts ready:1
    v} *)

open Dolphin_semantics

type t
(** What the log remembers of the run so far. *)

val start : t
(** Before the first line. *)

(** {1 Lines} *)

(** How much a line matters to whoever watches. *)
type severity =
  | Trouble  (** a failure, a lost link, the end of a run that did not complete *)
  | Said  (** what the program says *)
  | Completed  (** that the run did *)
  | Ordinary

type line = {
  about : Core.vehicle list;  (** whom it is about *)
  severity : severity;
  text : string;  (** which may have several lines *)
}

val is_shown : quiet:bool -> only:Core.vehicle list -> line -> bool
(** [is_shown ~quiet ~only l] is whether [l] stays if only trouble and what the program says is wanted ([quiet]), and
    only what is about the vehicles [only], unless that is [[]]. Trouble and the end always stay. *)

val tint : colour:bool -> line -> string
(** Its text, coloured by its severity if [colour]. *)

val transition : ?stuck:bool -> t -> time:float -> Transition.t -> t * line list
(** [transition l ~time s] is the lines that tell of [s], in the order in which things happen, and the log after it.
    What cannot be seen from outside has no line, nor has the question of an [ask], which {!question} tells. With
    [~stuck:true] an interruption is told as what it is then: nobody's wish, but the end of a program that is stuck. *)

val news : t -> time:float -> World.vehicle_state -> t * line list
(** [news l ~time state] tells of vehicles of the program that lose their link or have it back. *)

val question : t -> time:float -> string -> string
(** [question l ~time prompt] is the line that asks [prompt]; the answer is to follow it. *)

val remark : t -> time:float -> string -> line
(** [remark l ~time text] is a line about what is unusual. *)

val words : Transition.t -> string
(** [words t] is what the log says of the deed, guard or timer that made [t]; [""] of other transitions. *)
