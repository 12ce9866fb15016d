(** The transitions of configurations by the function that [proofs/] is about, extracted to OCaml. *)

open Dolphin_semantics

val internal : Core.program -> World.t -> Configuration.t -> Transition.t Seq.t
(** As {!Transition.internal}, in closed worlds.

    @raise Invalid_argument if the task has a [fresh], which the calculus does not have. *)

val accept :
  Core.program -> World.t -> Configuration.t -> Transition.event -> (Transition.t, Transition.refusal) result
(** As {!Transition.accept}, in closed worlds.

    @raise Invalid_argument as {!internal}. *)
