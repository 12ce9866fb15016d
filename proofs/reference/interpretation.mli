(** The parameters of the calculus: code runs on the machine of [lib/semantics/language], vehicles are chosen and fit
    as there, and messages are the same. *)

open Dolphin_semantics

val code :
  Core.program -> vehicles:Core.vehicle list -> machine:Machine.t option -> answer:Core.closure option ->
  Interpreter.code0
(** [code p ~vehicles ~machine ~answer] is the code of [p] in a closed world, in a configuration of which [vehicles]
    may be held or run tasks, with the script's [machine]; [answer] is the code of the text that answers [ask]. *)
