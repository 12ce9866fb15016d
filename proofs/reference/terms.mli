(** Configurations of [lib/semantics] as those of the calculus of [proofs/], and back. What is code, a value, the store,
    N or the script's machine is the same on both sides. The calculus has no place for [Completes], [idle], [repeat] and
    [recruit]: on the way back it is {!Dolphin_semantics.Fault.unknown_site}. *)

open Dolphin_semantics

val names : Interpreter.names
(** Equality of vehicles and stores. *)

val task : Core.task -> Interpreter.task
(** The same task. *)

val to_task : Interpreter.task -> Core.task
(** The same task; a [fresh] that was opened is its code again. *)

val opened : Interpreter.task -> (Residual.timer list * Core.task) list
(** The numbers of the keys and the task of each [fresh] that was opened, as {!Dolphin_semantics.Allocation.opened} has
    them. *)

val deeds : Code.deed list -> Interpreter.deed list
(** The same deeds. *)

val to_deeds : Interpreter.deed list -> Code.deed list
(** The same deeds. *)

val of_pick : Settings.pick -> Interpreter.pick
(** What the pick asks for. *)

val shared : Shared.t -> Interpreter.shared
(** The same shared part. *)

val to_shared : vehicles:Core.vehicle list -> Interpreter.shared -> Shared.t
(** The same shared part; only [vehicles] run tasks. *)

val configuration : Configuration.t -> Interpreter.configuration
(** The same configuration. *)

val to_configuration : vehicles:Core.vehicle list -> Interpreter.configuration -> Configuration.t
(** The same configuration; [vehicles] may run tasks. *)

val event : Transition.event -> Interpreter.event
(** The same event. The text of an answer goes without its code. *)

val label : Interpreter.label -> Label.t
(** The same label. *)

val transition :
  vehicles:Core.vehicle list -> Interpreter.ctransition * string list -> Transition.t
(** The same transition with its derivation; [vehicles] may run tasks after it. *)
