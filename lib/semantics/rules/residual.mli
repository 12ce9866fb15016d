(** What is left of an executing task: its vehicles assigned, what is done dropped. Residuals are kept in normal form
    (nothing that is done remains; [>>] leans to the right, [|] is flat; an [allOf] with one branch left is a
    [oneOf]), so that tasks which behave alike are more often equal.

    Residuals offer their steps as data: what a step needs of the rest of the configuration (an {!type-offer}), and
    what becomes of the residual once that is settled (a {!type-change}). The transition function, and nobody else,
    makes steps of configurations from these. *)

open Core

(** A timer that [idle] or [during] starts, by its place in the executed task, from 1. *)
type timer = int

type t =
  | Ready of platform_task * vehicle  (** about to start *)
  | Running of platform_task * vehicle
  | Action of closure
  | Condition of closure
  | Sequence of t * t list  (** what runs, which is no [Sequence], and at least one part to come *)
  | Parallel of t list  (** at least two, none of them [Parallel] *)
  | All_of of t option * branch list
  (** the branch that runs and at least one other; or none, and at least two *)
  | One_of of branch list
  | Until of closure * t
  | Idle of { timer : timer; seconds : float }
  | During of { timer : timer; duration : duration; started : bool; body : t }
  | Watch of t * closure

and branch = { guard : closure; body : t }

val compare : t -> t -> int
(** A total order, with {!equal} and {!hash}; code is compared by its place in the program and by what it captured. *)

val equal : t -> t -> bool
val hash : t -> int

val pp : Format.formatter -> t -> unit
(** A short text in the language's syntax. *)

(** {1:normal Normal forms} *)

val sequence : t -> t -> t
(** [sequence r r'] is [r >> r']. *)

val parallel : t list -> t
(** [parallel rs] is the residuals [rs], at least one, side by side. *)

val all_of : t option -> branch list -> t
(** [all_of running remaining] is the [allOf] whose branch [running] has begun; [remaining] are those to come. There
    is one at least. *)

val activate : t -> t * (timer * float) list
(** [activate r] is [r] about to run, and the timers that start with it, with their seconds. A [during] whose time is
    given by code starts in a step of its own. *)

(** {1:steps Local steps} *)

(** What a step needs. *)
type offer =
  | Start of platform_task * vehicle  (** nothing; A(v) becomes the task *)
  | Perform of closure  (** to run this action *)
  | Check of closure  (** that this condition is true *)
  | Measure of closure  (** the seconds that this code gives *)
  | End_of of platform_task * vehicle  (** that the vehicle reports the end *)
  | Expiry_of of timer  (** that the timer expires *)

(** What no longer runs. *)
type undoing =
  | Cancel of timer
  | Cut of t list  (** residuals that were cut off: their timers are cancelled, then their vehicles stop *)

(** How it was settled. *)
type reply = Went | Gave of float  (** to [Measure] *) | Broke of Fault.t

type outcome =
  | Next of t
  | Finished
  | Failed of Fault.t
  | Handling of {
      handler : closure;
      fault : Fault.t;
      ignored : unit -> change;  (** after [ignore()] *)
      propagated : Fault.t -> change;  (** after [propagate()], or if the handler itself breaks *)
    }

and change = {
  outcome : outcome;
  rules : Rule.t list;  (** the derivation, innermost rule first *)
  timers : (timer * float) list;  (** that start *)
  undone : undoing list;  (** in the order of the derivation, innermost rule first *)
}

type step = { offer : offer; continue : reply -> change }

val steps : t -> step Seq.t
(** [steps r] is all that [r] can do, leftmost first, computed on demand. *)

val internal_steps : t -> step Seq.t
(** [internal_steps r] is [steps r], less some of those that wait for an end or an expiry. *)

val steps_of_vehicle : vehicle -> t -> step Seq.t
(** [steps_of_vehicle v r] is [steps r], less some that do not wait for the end of a task of [v]. *)

(** {1:contexts Contexts}

    A residual that has begun stands in contexts: [opened] takes them off, one after the other. Changes of the residual
    are changes of the whole by the contexts alone, whatever the residual is; so its steps are worked out once for all
    that may stand beside it. *)

type context =
  | Before of t list  (** [_ >> t1 >> ... >> tn] *)
  | Branch_of of branch list  (** [allOf(_; bs)] *)
  | Body_until of closure
  | Body_during of timer * duration  (** the timer runs *)
  | Watched_by of closure

val opened : t -> (context * t) option
(** [opened r] is the outermost context of [r], and what is in it, if anything in it has begun. A [Parallel] is no
    context. *)

val within : context -> t -> t
(** [within k r] is [r] in [k], in normal form. *)

val change_within : context -> change -> change
(** [change_within k c] is the change of [within k r] by a step of [r] that changes [r] by [c]. *)

val cut : context -> t -> step option
(** [cut k r] is the step of [within k r] that is none of [r]: the cut of an [until] or a [during]. [steps (within k r)]
    is this one, and those of [r] with their changes within [k]. *)

(** {1:active What is active} *)

val running : t -> vehicle list
(** [running r] is the vehicles that run a task of [r]. *)

val timers : t -> timer list
(** [timers r] is the timers of [r] that have started. *)
