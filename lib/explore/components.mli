(** The components of a residual: what stands side by side in it, each with footprints of its steps. The parts of a
    [|] inside of an [until], a started [during], or a [watch] that may go on after an error of its task, are no
    components by themselves: steps of one can take away those of another. *)

open Dolphin_semantics

type component = {
  steps : int array;  (** the component's steps, by their place in {!type-t}'s [footprints] *)
  beside : Footprint.t;  (** all that the other components of the same residual may do until it is over *)
  alone : bool array;
  (** by place in [steps]: whether a step starts a branch of an [allOf] that may as well run first. Its guard takes
      and needs what no other branch touches; its body has steps that are always possible, touch nothing, and can end
      it. *)
}

type t = {
  footprints : Footprint.t array;  (** of each step *)
  ends : bool array;  (** by step: whether it may end the run *)
  components : component array;
  branches : Footprint.t array;  (** by step: for one that is [alone], the footprint of its whole branch *)
  future : Footprint.t;  (** all that the residual may do until it is over *)
}

(** A step of a residual, by its number in [Residual.steps], on one of the events it awaits. *)
type step = { index : int; source : Residual.step; event : Transition.event option }

type context

val context : Environment.options -> Core.program -> context

val analyse : context -> Residual.t -> step array -> t
(** [analyse c r steps] is for [steps], all the steps of [r]. *)
