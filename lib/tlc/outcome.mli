(** The complete result of TLC. *)

(** The states of a counter-example after the initial one. *)
type step = { action : string option; state : string  (** as in {!Tlc_message.State} *) }

(** The cycle of a counterexample, if it has one. *)
type repetition = Once | Stays | Back_to of int  (** that many steps from the start *)

(** {!Tlc_message.Unnamed} comes with its last steps only. *)
type counter_example = { violation : Tlc_message.violation; steps : step list; repetition : repetition }

(** TLC's verdict on all that it was asked. *)
type verdict =
  | Holds
  | Violated of counter_example  (** the first that TLC came across: it looks no further *)
  | Unfinished  (** it ended, or was ended, before the search did *)
  | Gave_up of string  (** an assertion of the model failed: its reason *)
  | Failed of string list  (** the error message of TLC, or Java *)

type t = {
  version : string option;
  generated : int;  (** states, counted as often as they were reached *)
  distinct : int;
  queue : int;  (** states whose successors were not looked at *)
  depth : int option;  (** of the complete state graph, in transitions *)
  verdict : verdict;
}

type reader
(** The result so far. *)

val start : reader
(** No event was read. *)

val event : reader -> Tlc_message.t -> reader
(** [event r e] is [r] after [e]. *)

val finish : reader -> t
(** The result, when the output has ended. *)

val java_too_old : string list -> (int * int) option
(** [java_too_old lines] is the required and the installed version of Java, if [lines], of {!Failed}, report this
    fault. *)
