(** The transition function: the whole semantics of Dolphin in one place, pure. The runtime, the explorer and the
    checker of traces call it and nothing else. docs/semantics.md gives the rules; {!Task_rules} and {!Local_step},
    {!Script_rules} and {!Pick_rules} have them.

    {[
      open Dolphin_semantics

      let program =
        let text = "v = pick { count 1 }\nexecute v: task('survey1')" in
        let ast = Result.get_ok (Dolphin_syntax.Parse.program ~file:"a.dol" text) in
        fst (Result.get_ok (Elaborate.program ~source_name:"a.dol" ast))

      let world = Dolphin_scenario.Scenario.(List.fold_left (Fun.flip World.add) World.empty (states default))

      (* The leftmost step of the program's own, until it waits for an event: the labels so far, and where it waits. *)
      let rec go c labels =
        match Transition.internal program world c () with
        | Seq.Cons (t, _) -> go t.next (Format.asprintf "%a" Label.pp t.label :: labels)
        | Nil -> (List.rev labels, c)

      let () =
        let labels, c = go (Configuration.initial program) [] in
        assert (labels = [ "pick(1 vehicle)"; "bind(noptilus-1)"; "execute"; "start(noptilus-1, survey1)" ]);
        assert (Transition.awaited c = [ End_of "noptilus-1" ]);
        match Transition.accept program world c (Vehicle_done "noptilus-1") with
        | Ok t -> assert (t.label = Done ("noptilus-1", "survey1"))
        | Error _ -> assert false
    ]} *)

open Core

(** The events from outside. *)
type event = Local_step.event =
  | Vehicle_done of vehicle  (** the vehicle ended its task *)
  | Vehicle_failed of vehicle * string
  (** it failed, refused the task, or its connection was lost for longer than its timeout: why *)
  | Timer_expired of Residual.timer
  | Confirmed of Residual.timer * (bool, string) result
  (** the question of a task was answered: whether by yes, or why it stays unanswered *)
  | Recruited of Residual.timer * vehicle  (** the vehicle is there for this [recruit] *)
  | Answered of { text : string; code : closure }  (** to [ask]: the typed text, and its code *)
  | Nobody_answers of string  (** why *)
  | Replied of value  (** by the host *)
  | Host_failed of string  (** why *)
  | Input of string * value  (** a pair of N that the outside posts *)
  | Interruption

val equal_event : event -> event -> bool
(** As {!Local_step.equal_event}. *)

type t = Conclusion.t = {
  rules : Rule.t list;  (** the derivation, from the axiom outwards *)
  label : Label.t;
  next : Configuration.t;
  effects : Effect.t list;  (** in the order in which they are to be carried out *)
  assumed : World.assumption list;  (** its assumptions about an open world; otherwise nothing *)
  otherwise : World.assumption list list;  (** other assumptions with the same conclusion *)
}

(** Why an event makes no transition. *)
type refusal =
  | Not_awaited  (** nothing in the configuration depends on it: it may be forgotten *)
  | Bad_answer of string  (** the answer is not an expression with a value: why; to be asked again *)

(** The events that a configuration waits for. *)
type awaited =
  | End_of of vehicle  (** that it is done with its task, or fails *)
  | Expiry_of of Residual.timer
  | Answer_to of Residual.timer * string  (** to this question, with its prompt, or that it stays unanswered *)
  | Recruit_for of Residual.timer * Vehicle_filter.t  (** that such a vehicle is there, for this [recruit] *)
  | Answer  (** to [ask], or that it stays unanswered *)
  | Reply  (** of the host, or that the host fails *)

val internal : program -> World.t -> Configuration.t -> t Seq.t
(** [internal p w c] is the transitions that [c] can make by itself, leftmost first, computed on demand. A [pick] has
    one for every choice of vehicles, in pick order. Steps that depend on values that [w] leaves open are not among
    them: see {!internal_all}. *)

val accept : program -> World.t -> Configuration.t -> event -> (t, refusal) result
(** [accept p w c e] is the transition of [c] on [e]. [Interruption] is accepted wherever the program has not ended,
    and so is [Input (k, x)] if [p] declares the key [k]. An event whose result depends on a value that [w] leaves
    open is not accepted: see {!accept_all}. *)

val on_interrupt : ?recruits:vehicle list -> Core.program -> Shared.t -> Machine.t -> Configuration.t option
(** [on_interrupt ~recruits p s m] is the result of ON-INTERRUPT for a configuration with the shared part [s] whose
    script stands at [m]; [None] where INTERRUPT ends the run. [recruits], by default none, is the vehicles that the
    executing task has recruited. *)

val is_leaving : Configuration.t -> bool
(** Whether the run was interrupted, and executes what [onInterrupt] declares. *)

val awaited : Configuration.t -> awaited list
(** [awaited c] is the events for which [c] has transitions, leftmost first, besides inputs and [Interruption]. The
    time-out of a [pick] is among them, but not accepted while the pick can be met: then it must be. *)

val awaits_event : Configuration.t -> bool
(** [awaits_event c] is whether [awaited c] has an event. *)

val recruitable : program -> World.t -> Configuration.t -> event Seq.t
(** [recruitable p w c] is the events [Recruited (i, v)] of the vehicles that a [recruit] of [c] asks for, wherever they
    are: the leftmost [recruit] first, vehicles in the order of [w]. *)

val recruited : program -> World.t -> Configuration.t -> (event * t) option
(** [recruited p w c] is the first of them that [c] accepts, with the transition. *)

val depends_on_sensors : program -> Configuration.t -> bool
(** [depends_on_sensors p c] is whether sensors of the world may matter to [c] or to later configurations: a driver
    then keeps them up to date. *)

val unknown : program -> World.t -> Configuration.t -> Fault.t list
(** [unknown p w c] is the values that guards of [c] need and vehicles have not reported: each such guard does not
    hold. *)

(** {1:open In open worlds}

    If the world leaves sensors open, there are transitions for all of their values, each with its assumptions. If a
    step has one label and one result under several assumptions, only the first is listed; if all assumptions lead to
    it, it assumes nothing. It is an error if more than a comparison depends on a reading ({!Core.reading}): the
    outcomes cannot be listed. In a closed world these are {!internal} and {!accept}. *)

val internal_listed : program -> World.t -> Configuration.t -> t Seq.t * Fault.t option
(** [internal_listed p w c] is the transitions that [c] can make by itself, leftmost first, but for those of steps whose
    outcomes cannot be listed; and the reason for the first of these. *)

val internal_all : program -> World.t -> Configuration.t -> (t Seq.t, Fault.t) result
(** [internal_all p w c] is the transitions that [c] can make by itself, leftmost first. *)

val accept_all : program -> World.t -> Configuration.t -> event -> ((t, refusal) result list, Fault.t) result
(** [accept_all p w c e] is the transitions of [c] on [e], at least one; or one refusal. *)

val distinct : ('a -> t) -> 'a Seq.t -> 'a Seq.t
(** [distinct transition xs] is [xs] less those whose transition has the label and the result of an earlier one. *)
