(** The rules of the script: its own steps, and the events that it waits for. *)

open Core

val step : program -> World.t -> Shared.t -> Machine.t -> Conclusion.t Decision.t
(** [step p w s m] is the transition of <script m, s>: SCRIPT, a deed, a request (PICK, ASK, PAUSE, CALL, EXECUTE or
    ALLOC-ERR), or an end. *)

val on_interrupt : ?recruits:vehicle list -> program -> Shared.t -> Machine.t -> Configuration.t option
(** [on_interrupt ~recruits p s m] is the result for a run with shared part [s], whose script stands at [m], if it is
    interrupted and executes the [onInterrupt] task of [p] then. [recruits], by default none, is the vehicles that
    the executing task has recruited. *)

val interrupt : program -> Configuration.t -> Machine.t -> Conclusion.t
(** [interrupt p c m] is ON-INTERRUPT, or INTERRUPT, of [c], whose script stands at [m]. *)

val go_on : Rule.t -> Label.t -> value -> Shared.t -> Machine.t -> Conclusion.t
(** [go_on rule l x s m] is the transition by which [m], which waited, goes on with [x]: RESUME, REPLY, ANSWER. *)

val fail : Rule.t -> Label.t -> string -> Shared.t -> Machine.t -> Conclusion.t
(** [fail rule l why s m] is the one by which the program ends because [m] waits in vain: ANSWER-ERR, CALL-ERR. *)

val answer :
  program -> World.t -> Shared.t -> Machine.t -> text:string -> closure -> (Conclusion.t, string) result Decision.t
(** [answer p w s m ~text code] is ANSWER, if [code], which was typed as [text], only computes a value; or the reason
    why not. *)
