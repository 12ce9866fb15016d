(** An observer watches the transitions of a search, and gives each a number: its action. *)

open Dolphin_semantics

type t = {
  action : Proposition.observed -> int;  (** of the observable part of a transition *)
  valuation : Encoding.t -> int -> int array -> int;
  (** [valuation e action key]: which valuation it makes that [action] leads to the state [key]; 0 if no formula is
      checked *)
}

val nothing : int
(** The action if there is no transition or no observer: 0. *)

val of_transition : t option -> Transition.t -> int
(** The action of a transition. *)

val of_event : t option -> ?ending:Configuration.ending -> Label.t -> int
(** That of a transition in which just this can be seen. *)

val of_local_step : t -> Local_step.t -> int
(** That of the transitions that the local step makes ({!Local_step.conclude}). *)
