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

val transition : ?stuck:bool -> t -> time:float -> Transition.t -> t * string list
(** [transition l ~time s] is the lines that tell of [s], in the order in which things happen, and the log after it.
    What cannot be seen from outside has no line, nor has the question of an [ask], which {!question} tells. With
    [~stuck:true] an interruption is told as what it is then: nobody's wish, but the end of a program that is stuck. *)

val news : t -> time:float -> World.vehicle_state -> t * string list
(** [news l ~time state] tells of vehicles of the program that lose their link or have it back. *)

val question : t -> time:float -> string -> string
(** [question l ~time prompt] is the line that asks [prompt]; the answer is to follow it. *)

val remark : t -> time:float -> string -> string
(** [remark l ~time text] is a line about the program. *)
