(** The symmetries that a search relies on: groups of automorphisms of the transition system, of two kinds. Vehicles are
    exchanged in configurations of the script ({!Canonical_vehicles}), and isomorphic subtasks in an executing task
    ({!Task_groups}). docs/explorer.md has the theory of both.

    Both are assumed at first, and checked in every state that is visited. If a state shows that one is broken, the
    search begins anew with less. *)

open Dolphin_semantics
open Dolphin_environment

(** A task that is executed, with what no step of it can change: other pairs of N, other variables, B. Executions that
    differ in this have no configuration in common. *)
type execution = { task : Residual.t; constant : Shared.t }

type t = {
  vehicles : Vehicle_orbits.t;
  tasks : (execution * Tuples.t) list option;
  (** [None]: subtasks are not exchanged. Otherwise, what N may be when an execution begins, as far as it is known to
      break a symmetry. *)
}

exception Broken of t
(** What is left of the symmetries that were assumed. What was found before does not count. *)

val none : t

val find : Environment.options -> Core.program -> asked:Condition.t list -> World.t -> t
(** [find o p ~asked w] is what can be assumed before anything is explored: {!Vehicle_orbits.find}, and symmetries of
    tasks unless the outside remembers vehicles, or posts, or some task recruits. *)

val without_tasks : t -> t
