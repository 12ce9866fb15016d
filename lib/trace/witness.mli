(** A counterexample in a file: the property that the run violates, and the choice or the event of each step, without
    times. [dolphin explore --trace] writes witnesses, [dolphin exec --follow] takes their steps again. A file has a
    line of JSON as its header, then one for each step. *)

open Dolphin_semantics

(** The cause of a step. *)
type cause =
  | Choice of int
  (** the transition that the program took by itself: its index in {!Transition.internal}, in the world with the
      assumptions *)
  | Event of Event.t

(** A step of the run. *)
type step = {
  cause : cause;
  assumed : World.assumption list;  (** the assumptions of the step about an open world *)
  label : string;
}

type t = {
  program : Header.source;
  fleet : Header.source option;
  property : string;  (** the violated property *)
  steps : step list;
  cycle : step list;  (** repeats without end after the steps; empty if the run ends *)
}

val version : int
(** Of the format. *)

val steps : Core.program -> World.t -> Configuration.t -> Transition.t list -> step list
(** [steps p w c run] is the transitions [run], one after the other from [c].
    @raise Invalid_argument if the semantics does not have these transitions. *)

(** The step that the semantics does not have, and the reason. *)
type misfit = { number : int;  (** of the step, from 1 *) why : string }

val follow : Core.program -> World.t -> t -> (Transition.t list * Transition.t list, Transition.t list * misfit) result
(** [follow p w witness] is the transitions of its steps, and those of its cycle, once around. The error has the
    transitions up to the first step that [p] cannot take there, or that has another label. *)

val to_lines : t -> string list
(** A header, then a line for each step, without line feeds. *)

val of_lines : string list -> (t, string) result
(** [of_lines (to_lines c)] is [c]; or what is wrong in which line. *)
