(** The symmetries that a search relies on: groups of automorphisms of the transition system, of two kinds. Vehicles are
    exchanged in configurations of the script ({!Canonical_vehicles}), and isomorphic subtasks in an executing task
    ({!Task_groups}). docs/explorer.md has the theory of both.

    Both are assumed at first, and checked in every state that is visited. If a state breaks a symmetry, the search
    starts again with fewer symmetries. *)

open Dolphin_semantics
open Dolphin_environment

(** A task being executed, with the part that none of its steps can change: other pairs of N, other variables, B.
    Executions that differ in this have no configuration in common. *)
type execution = { task : Residual.t; constant : Shared.t }

type t = {
  vehicles : Vehicle_orbits.t;
  tasks : (execution * Tuples.t) list option;
  (** [None]: subtasks are not exchanged. Otherwise, the possible values of N at the beginning of an execution, as
      far as they are known to break a symmetry. *)
}

exception Broken of t
(** The remaining assumed symmetries. Earlier results do not count. *)

val none : t
(** No symmetry: each state stands for itself. *)

val find :
  Environment.options -> Core.program -> asked:Condition.t list -> ?named:(Core.vehicle -> bool) -> World.t -> t
(** [find o p ~asked ~named w] is the symmetry that can be assumed before the exploration: {!Vehicle_orbits.find}, and
    symmetries of tasks unless the environment remembers vehicles, or posts, or some task recruits. *)

val without_tasks : t -> t
(** [without_tasks s] is the symmetries of vehicles and of the environment in [s], without those of tasks. *)
