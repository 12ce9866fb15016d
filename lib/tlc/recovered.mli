(** Counter-examples of TLC as runs of the semantics, by their labels. *)

open Dolphin_semantics
module Environment := Dolphin_environment.Environment

(** A run of the semantics. *)
type run = {
  steps : Transition.t list;
  cycle : Transition.t list;  (** goes on from there without end, if it does *)
}

type trouble =
  | No_label of int  (** the state after this number of steps does not name the label by which it was reached *)
  | No_such_run of { after : string list; label : string }
  (** the semantics can do [after], but then not [label]: the two statements of the semantics differ *)
  | Does_not_return of string list  (** these labels, of the cycle, lead to another state than TLC reports *)

val run :
  Environment.options -> Core.program -> World.t ->
  broken:(Dolphin_explore.Labelled.state -> Transition.t list -> bool) ->
  Outcome.counter_example -> (run, trouble) result
(** [run o p w ~broken c] is a run with the labels of [c], which are the values of the variable [label] in its states.
    If there are several, one for whose last state and transitions [broken] holds is preferred. *)

val pp_trouble : Format.formatter -> trouble -> unit
(** One sentence without a full stop. *)
