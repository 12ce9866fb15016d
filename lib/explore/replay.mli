(** Runs that lead to states of a {!Space}, transition by transition. *)

open Dolphin_semantics

val between : Environment.options -> Core.program -> World.t -> Space.t -> int list -> Transition.t list
(** [between o p w s states] is transitions that lead through [states], in this order. Each is one that the semantics
    offers between the two configurations.
    @raise Invalid_argument if there is none, which would be an error of {!Space}. *)

val shortest : Space.t -> int -> int list
(** [shortest s i] is states from the initial one to [i], as few as can be. *)
