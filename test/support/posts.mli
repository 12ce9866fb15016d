(** Posts of people to random programs. *)

open Dolphin_semantics
open Dolphin_environment

val inputs : Environment.input list
(** With two keys of the pairs that random programs look at; with one of them it is certain that they do. *)

val once : Environment.input list
(** One pair, perhaps. *)

val declared : Environment.options -> Core.program -> Core.program
(** [declared o p] is [p], which declares these keys if [o] has inputs. *)
