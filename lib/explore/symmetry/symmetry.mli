(** States of an executing task up to what can change places in it. Two states are alike if one becomes the other by
    exchanging things of {!Automorphism}, by the names that do not matter, and by the order of what stands side by side;
    one of those
    alike is looked at for all. docs/explorer.md says why that is enough. *)

open Dolphin_semantics

(** {1:groups Groups} *)

type t
(** What can change places in one task: a group of permutations. *)

(** What is shared, by numbers. *)
type shareds = { number : Shared.t -> int; value : int -> Shared.t }

val create :
  Task_isomorphism.context ->
  shareds ->
  number:int ->
  classes:(Task_isomorphism.label * Task_isomorphism.label list) list ->
  Residual.t ->
  Automorphism.t ->
  t
(** [create a s ~number ~classes r i] is what [i] found in [r]; [classes] has all that can change places with a label,
    for each label of [r]. *)

val number : t -> int
(** As it was given. *)

val together : t -> Task_isomorphism.label -> Task_isomorphism.label list
(** [together g l] is all that can change places with [l], itself included. *)

(** {1:states States}

    A state is the kinds of the parts that stand side by side, each a number, in any order, and what is shared. *)

type state = { kinds : int array; shared : int }

val kind : t -> Residual.t -> int
(** [kind g r] is the same for residuals that differ in names that do not matter. *)

val residual : t -> int -> Residual.t
(** [residual g k] is some residual of kind [k]. *)

val state : t -> Residual.t list -> int -> state
(** [state g rs s] is the residuals [rs] side by side, with shared [s]; kinds ascend. *)

type permutation

val identity : t -> permutation

val compose : permutation -> permutation -> permutation
(** [compose p q] is [q], then [p]. *)

val apply : t -> permutation -> state -> state
(** Kinds ascend. *)

val canonical : t -> int array -> int -> state * permutation
(** [canonical g kinds s] is a state that is alike, mostly the same one for all that are, and the permutation that leads
    there. *)

val images : t -> int -> (int * permutation) list
(** [images g s] is each that shared [s] can become by some permutation, with one that does it: itself first. *)
