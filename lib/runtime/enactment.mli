(** A run that is known before it is made, a counterexample perhaps, carried out on a platform.

    The transitions come in the given order, and the platform gives the times. The end of a task and the expiry of a
    timer come when the platform reports them, or if others are to come first, after those: such a task took longer,
    such a timer was noticed late. Whatever else happens outside happens as soon as it may. So every run of the
    semantics can be carried out, with times that suit it. *)

open Dolphin_semantics

(** A step of the run, and its cause. *)
type step = {
  cause : Transition.event option;  (** [None]: the program takes it by itself *)
  transition : Transition.t;
}

val run :
  (module Platform.S with type t = 'p) -> 'p -> observer:Observer.t -> interruption:unit Lwt.t ->
  ?giving_up:((unit -> unit) -> unit) -> Core.program -> step list -> Driver.outcome Lwt.t
(** [run (module P) platform ~observer ~interruption program steps] takes [steps], which are one after the other from
    the initial configuration, until they are over or [interruption] resolves. Tasks that still run then are stopped
    and their vehicles released: the outcome is [Stuck] if the program cannot continue at the end of the steps;
    [giving_up] is as of {!Driver.run}.
    Resolves once [platform] is closed. *)
