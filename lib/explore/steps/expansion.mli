(** Transitions of states in which a task executes, as vectors of words. {!Space} selects the steps to take. *)

open Dolphin_semantics
open Dolphin_environment
open Dolphin_checker

type t

val create :
  Environment.options -> Components.t -> Encoding.t -> Memoised_steps.t -> Quotient.t -> Observer.t option -> t
(** [create o components encoding steps quotient observer] is for states of these components in this encoding, whose
    vectors are then of unknown length ({!widen}). [observer] numbers actions; without one all are 0. *)

val follows : t -> int -> int -> unit
(** [follows t p p'] notes that place [p'] of the script may come after place [p], by the numbers of
    {!Encoding.write}. *)

val edges : t -> (int * int) list
(** The notes of {!follows}, for any caller. *)

val may_cycle : t -> bool
(** Whether some place of the script may come after itself. *)

val widen : t -> words:int -> unit
(** Vectors have [words] words from now on. *)

(** The state being expanded. *)
type source = {
  expansion : t;
  key : int array;  (** changed in place for successors of the same layout, and changed back *)
  layout : Layout.t;
  shared : int;  (** the number of its shared state *)
  visitor : Task_group.permutation option System.visitor;
  mutable surroundings : (Layout.place * Memoised_steps.surroundings) list;  (** those that were asked for, by place *)
}

val source :
  t -> key:int array -> layout:Layout.t -> shared:int -> Task_group.permutation option System.visitor -> source
(** The state [key], to be expanded: none of its surroundings is known yet. *)

(** All of these visit states, or representatives of them with the permutation that leads there.
    @raise Layouts.Outgrown *)

val go_to : source -> Layout.place -> Component.target -> action:int -> int -> unit
(** [go_to x p target ~action s] visits [x] with [target] at [p], in shared state [s]. *)

val outcome : source -> Layout.place -> Component.step -> Component.outcome
(** [outcome x p step] is the outcome of [step] at [p]. *)

val take_dependent : source -> Layout.place -> Component.step -> int
(** [take_dependent x p step] takes [step] at [p]. The result is how many transitions that makes. *)

val take_outcome : source -> Layout.place -> Component.outcome -> unit
(** [take_outcome x p o] visits the successors for the possible outcome [o] of a step at [p]. *)

val take_ends : source -> Layout.place -> Component.step -> int
(** The same, restricted to outcomes that end the run. *)

val inputs : source -> int
(** [inputs x] takes each input that may come. The result is how many transitions that makes. *)

val upcoming : t -> int -> Footprint.t
(** [upcoming t s] is the footprint of all inputs that may come in shared state [s], or later. *)

val interrupt : source -> int
(** [interrupt x] takes the interruption, if there is one. If nothing follows it, it breaks nothing: whatever states
    are explored, verdicts are the same with it. If the program prints the tasks that it executes, all states are
    explored. The result is how many transitions that makes. *)

val write_and_visit :
  t -> Task_group.permutation option System.visitor -> Rule.t list -> Configuration.t -> Environment.t ->
  action:int -> int
(** [write_and_visit t v rules c e ~action] visits [c] with [e], which a step by [rules] led to. The result is its place
    of the script. *)
