(** The rules of the script: what it does by itself, and what it waits for. *)

open Core

val step : program -> World.t -> Shared.t -> Machine.t -> Conclusion.t Decision.t
(** [step p w s m] is the transition of <script m, s>: SCRIPT, a deed, a request (PICK, ASK, PAUSE, CALL, EXECUTE or
    ALLOC-ERR), or an end. *)

val on_interrupt : ?recruits:vehicle list -> program -> Shared.t -> Machine.t -> Configuration.t option
(** [on_interrupt ~recruits p s m] is what becomes of a run with shared part [s], whose script stands at [m],
    if it is interrupted
    and executes what [p] declares by [onInterrupt] then. [recruits], by default nobody, is whom the task that executes
    has recruited. *)

val interrupt : program -> Configuration.t -> Machine.t -> Conclusion.t
(** [interrupt p c m] is ON-INTERRUPT, or INTERRUPT, of [c], whose script stands at [m]. *)

val go_on : Rule.t -> Label.t -> value -> Shared.t -> Machine.t -> Conclusion.t
(** [go_on rule l x s m] is the transition by which [m], which waited, goes on with [x]: RESUME, REPLY, ANSWER. *)

val fail : Rule.t -> Label.t -> string -> Shared.t -> Machine.t -> Conclusion.t
(** [fail rule l why s m] is the one by which the program ends because [m] waits in vain: ANSWER-ERR, CALL-ERR. *)

val answer :
  program -> World.t -> Shared.t -> Machine.t -> text:string -> closure -> (Conclusion.t, string) result Decision.t
(** [answer p w s m ~text code] is ANSWER, if [code], which was typed as [text], only computes a value; or why it is
    none. *)
