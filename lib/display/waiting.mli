(** The events that a program awaits, besides its vehicles: the reason why it makes no step. *)

open Dolphin_semantics

type t = {
  what : string;  (** ["consume(ready: 2) && battery(v) > 0.3"], in the words of the program; ["an answer"] *)
  at : Dolphin_syntax.Location.t option;
  lacking : string option;
  (** of several conditions joined by [&&], the first that does not hold: ["not yet battery(v) > 0.3"]; of a [pick],
      how many vehicles are in reach *)
}

val text : Core.program -> source:string -> Core.site -> string option
(** [text program ~source site] is the text at [site] of [source], the text of [program], in one line. *)

(** A question of the program, or of a task. *)
type question = {
  at : Dolphin_syntax.Location.t option;
  is_confirm : bool;  (** it takes yes or no; others take any value *)
}

val question : Core.program -> source:string -> Configuration.t -> string -> question
(** [question program ~source c prompt] is the place where [c] asks [prompt], and whether by [confirm]. *)

val list : Core.program -> source:string -> World.t -> Configuration.t -> t list
(** [list program ~source world c] lists the guards that [c] awaits in [world], each place of the program once,
    leftmost first. [source] is the text of [program]. The tasks of vehicles are not among it. *)
