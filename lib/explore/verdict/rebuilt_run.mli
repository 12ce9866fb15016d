(** Runs that lead to states of a {!State_graph}, transition by transition. Each transition is one that the semantics
    offers between the two configurations. All of these functions raise [Invalid_argument] if there is none, which
    would be an error of {!State_graph}. They call [tick] at each choice that they look at, and raise what it
    raises. *)

open Dolphin_semantics

val through : tick:(unit -> unit) -> State_graph.t -> int list -> Transition.t list
(** [through ~tick g states] is transitions from the initial configuration that lead through [states], in this order. *)

val around :
  tick:(unit -> unit) -> State_graph.t -> stem:int list -> int list -> Transition.t list * Transition.t list
(** [around ~tick g ~stem states], where [states] lead from the last one of [stem] back to it, is transitions through
    [stem], and transitions that continue through [states] and return to their start. Where states are
    representatives, both may traverse [states] several times. *)
