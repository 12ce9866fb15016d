(** The possible reads and writes of the components of an executing task. Here a nest counts as a component too: its
    steps are those of its contexts, the cuts. The surroundings of a component are the contexts of its nests, the
    innermost nest first, and in each the innermost context first. *)

open Dolphin_semantics
open Dolphin_environment

type t = {
  footprints : Footprint.t array;  (** of each step *)
  ends : bool array;  (** by step: whether it may end the run *)
  put_off : bool array;  (** by step: whether it may never come, though it stays possible *)
  futures : Footprint.t array;
  (** by level: everything that the component may do until it is over, with the tasks that follow it inside that many
      nests *)
  cut_by_error : bool array;
  (** by level, from 1: whether the nest that many levels above may ignore an error of the component, so that
      everything in it is cut off *)
  runs_first : Footprint.t option array;
  (** by step: the footprint of the whole branch of an [allOf] that the step starts, if the branch may run first. Its
      guard takes and needs what no other branch touches; the steps of its body are always possible, touch nothing, and
      can end it. *)
}

(** A step of a residual or nest, by its number in [Task_rules.steps], on one of the events it awaits, as a step of the
    whole task ({!Error_path}). *)
type step = { index : int; source : Task_rules.step; event : Transition.event option }

type context
(** The footprints of a program's code, and what the environment lets happen. Mutable: results are memoised. *)

val context : Environment.options -> Core.program -> context
(** [context o p] is for tasks of [p] in the environment [o]. *)

val with_holding : context -> context
(** [with_holding c] is [c] for tasks that make tasks at their turn: footprints include held and freed vehicles. In
    others nothing depends on that, unless code asks who is idle. *)

val looks : context -> Task_rules.step -> bool
(** [looks c step] is whether [step] may depend on which vehicles are held around it. *)

val of_residual : context -> Residual.t -> Footprint.t
(** [of_residual c r] covers all steps of [r] and of its successors. *)

val of_component : context -> Residual.context list list -> Residual.t -> step array -> t
(** [of_component c nests r steps] is for [steps], all the steps of [r]. *)

val of_cuts : context -> Residual.context list list -> step array -> t
(** [of_cuts c nests steps] is for [steps], all the cuts of the first of [nests]; the component's level 0 is around that
    nest. *)
