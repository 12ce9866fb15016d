(** The group of automorphisms of one task, and states of the task up to it.

    A {e block} is the pairs of N that belong to one of several isomorphic subtasks. The group is given by its orbits of
    blocks: it is the product of the symmetric groups on the orbits ({!Automorphism}). docs/explorer.md proves that the
    quotient by it has the same verdicts. *)

open Dolphin_semantics

(** {1:groups Groups} *)

type t

(** The numbers of shared parts. *)
type shareds = {
  numbering : Dolphin_checker.Numbering.t;
  number : Surroundings.t -> int;
  value : int -> Surroundings.t;
}

val create :
  Task_isomorphism.context ->
  shareds ->
  number:int ->
  equivalent:(Task_isomorphism.label * Task_isomorphism.label list) list ->
  Residual.t ->
  Automorphism.t ->
  t
(** [create c s ~number ~equivalent r a] is the group that [a] gives for [r]. [equivalent] has, for each label of [r],
    the labels in its orbit, itself included. *)

val number : t -> int
(** As it was given. *)

val equivalent : t -> Task_isomorphism.label -> Task_isomorphism.label list
(** [equivalent g l] is the orbit of [l]. *)

(** {1:states States}

    A state is the component classes of the parallel parts at the top, each a number, and the shared part. *)

(** The component classes, ascending, and the number of the shared part. *)
type state = { classes : int array; shared : int }

val class_of : t -> Residual.t -> int
(** [class_of g r] is the component class of [r]: residuals have the same one if they differ only in names that no step
    depends on. *)

val representative : t -> int -> Residual.t
(** [representative g k] is the first residual of class [k] that was seen. *)

val state : t -> Residual.t list -> int -> state
(** [state g rs s] is the residuals [rs] side by side, with shared [s]. Classes ascend. *)

type permutation
(** Of blocks. *)

val identity : t -> permutation
(** [identity s] moves no block of [s]. *)

val compose : permutation -> permutation -> permutation
(** [compose p q] is [q], then [p]. *)

val apply : t -> permutation -> state -> state
(** Classes ascend. *)

val canonical : t -> int array -> int -> state * permutation
(** [canonical g classes s] is a state in the orbit of [{ classes; shared = s }], and the permutation that leads there.
    It depends on the multiset of classes only. States of one orbit mostly, but not always, have the same one. *)

val orbit_of_shared : t -> int -> (int * permutation) list
(** [orbit_of_shared g s] is the orbit of shared [s], [s] first, each with a permutation that leads there. *)
