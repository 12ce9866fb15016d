(** The questions that a configuration puts to people, with the timers that may end them. *)

open Dolphin_semantics

type t = {
  prompt : string;
  site : Core.site;
  is_of_task : bool;  (** it takes yes or no, and the program goes on meanwhile *)
  timers : Residual.timer list;  (** of the [during] and [within] around it that have begun, the innermost first *)
}

val list : Configuration.t -> t list
(** [list c] is the open questions of [c], from left to right. *)
