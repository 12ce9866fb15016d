(** The parameters of the calculus: code runs on the machine of [lib/semantics/language], vehicles are chosen and fit
    as there, and messages are the same. *)

open Dolphin_semantics

exception Undecided
(** The script depends on a value that the world leaves open. *)

val code :
  ?undecided:(World.question -> unit) -> Core.program -> vehicles:Core.vehicle list -> machine:Machine.t option ->
  answer:(string -> Core.closure option) -> Interpreter.code0
(** [code ~undecided p ~vehicles ~machine ~answer] is the code of [p] in a configuration of which [vehicles] may be held
    or run tasks, with the script's [machine]; [answer text] is the code of [text], if that answers [ask]. Code that
    depends on an open value calls [undecided], by default [ignore], with the question, and has no result. *)
