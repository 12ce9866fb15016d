(** Propositions of formulas of temporal logic: about the last transition, and about the state that it led to. *)

open Dolphin_semantics

type t

val of_string : Core.program -> string -> (t, string) result
(** [of_string p text] is the proposition that [text] spells. Of transitions: [start], [done] and [fail], of a plan
    and a vehicle if they are given: [start(survey1)], [done(survey1, noptilus-1)]; [bind(vehicle)];
    [message('text')]; [post(key: value)], [post(key)], and [consume] in the same form; [timeout], [execute], [pick],
    [ask], [answer], [pause], [end], [halt], [error] (the end by an error or a failed assertion). Of states:
    [running] and [bound], with names that need no quotes, [poll(key: value)], [ended], and any {!Condition} in
    braces. *)

val needs_action : t -> bool
(** Whether it is about transitions: then it is false in the first state, and after the end. *)

val names : t -> Core.vehicle -> bool
(** [names p v] is whether [p] may hold of [v] and not of another vehicle only because of their names. It is false for
    names in the code of a {!condition}. *)

val condition : t -> Condition.t option
(** The condition that it evaluates, if it is one of states. *)

val running : t -> (string * string option) list
(** As {!Condition.running}. *)

(** The part of a transition that propositions observe. *)
type observed = {
  label : Label.t;
  effects : Effect.t list;
  ending : Configuration.ending option;  (** if it ends the run *)
}

val observed : Transition.t -> observed
(** [observed t] is that part of [t]. *)

val holds_after : t -> observed -> bool
(** [holds_after p (observed t)] is whether [p], which is of transitions, holds of [t]. *)

val holds_in : Core.program -> World.t -> t -> Configuration.t -> (bool, string) result
(** [holds_in p w q c], for [q] of states; false while a variable has no value. The error is that of the condition's
    code. *)
