(** What TLC found, all told. *)

(** The states of a counter-example after the initial one. *)
type step = { action : string option; state : string  (** as in {!Event.State} *) }

(** How a counter-example goes on for ever, if it does. *)
type repetition = Once | Stays | Back_to of int  (** that many steps from the start *)

(** What is {!Event.Unnamed} comes with its last steps only. *)
type counter_example = { violation : Event.violation; steps : step list; repetition : repetition }

type verdict =
  | Holds
  | Violated of counter_example  (** the first that TLC came across: it looks no further *)
  | Unfinished  (** it ended, or was ended, before the search did *)
  | Gave_up of string  (** an assertion of the model says so: why *)
  | Failed of string list  (** what TLC, or Java, says went wrong *)

type t = {
  version : string option;
  generated : int;  (** states, counted as often as they were reached *)
  distinct : int;
  queue : int;  (** states whose successors were not looked at *)
  depth : int option;  (** of the complete state graph, in transitions *)
  verdict : verdict;
}

type reader

val start : reader
val event : reader -> Event.t -> reader

val finish : reader -> t
(** What was found, when the output has ended. *)

val java_too_old : string list -> (int * int) option
(** [java_too_old lines] is the versions of Java that are needed and that is there, if [lines], of {!Failed}, say that
    this is what went wrong. *)
