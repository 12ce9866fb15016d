(** Steps of a residual in a shared part: [S, r --l--> S', o ! E]. {!Task_rules} defines the needs of a step; here it
    gets them from the shared part, the world or an event.

    The transitions of a configuration that executes a residual are those of the residual's steps:
    [Transition.internal] is {!internal} of each step, and [Transition.accept] is {!on_event}, both completed by
    {!conclude}. The result of a step depends on the step and the shared part alone, so it can be computed once for
    all residuals that contain it. *)

open Core

(** The events from outside. *)
type event =
  | Vehicle_done of vehicle  (** the vehicle ended its task *)
  | Vehicle_failed of vehicle * string
  (** it failed, refused the task, or its connection was lost for longer than its timeout: why *)
  | Timer_expired of Residual.timer
  | Confirmed of Residual.timer * (bool, string) result
  | Recruited of Residual.timer * vehicle  (** the vehicle is there for a recruit *)
  | Answered of { text : string; code : closure }  (** to [ask]: the typed text, and its code *)
  | Nobody_answers of string  (** why *)
  | Replied of value  (** by the host *)
  | Host_failed of string  (** why *)
  | Input of string * value
  | Interruption

val equal_event : event -> event -> bool
(** Whether all parts are the same; values as {!Value.compare} has it, so that [1] and [1.0] differ. *)

(** The new residual. *)
type outcome =
  | Goes_on of Residual.t
  | Over
  | Ends of Configuration.ending  (** and so does the whole program *)

type t = {
  after : Shared.t;
  outcome : outcome;
  derivation : Rule.t list;
  named : Label.t;
  asked : Effect.t list;
  rounds : Task_rules.round list;  (** that begin *)
}

val internal : program -> World.t -> Shared.t -> Task_rules.step -> t option Decision.t
(** [internal p w s step] is the result of [step] without an event with shared part [s], if it is enabled. *)

val on_event : program -> World.t -> Shared.t -> Task_rules.step -> event -> t option Decision.t
(** [on_event p w s step e] is the result of [step] on [e], if it awaits that. *)

val equal : t -> t -> bool
(** Whether two steps of one residual have the same label and the same result. *)

val next : Machine.t -> outcome -> Shared.t -> Configuration.t
(** [next m o s] is the configuration after a step with outcome [o] of the residual that [m] waits for; [s] is the
    shared part then. *)

val conclude : ?on:event -> Machine.t -> Residual.t -> t -> Conclusion.t
(** [conclude ~on m r l] is the transition of a configuration in which [m] waits for [r], by a step of [r] that does
    [l]: EXECUTE-DONE, EXECUTE-ERR, or no further rule. [on] is the event of the step, if it needs one: at the end of
    the program, the timer that expired is not cancelled, and the question that was answered is not withdrawn. *)
