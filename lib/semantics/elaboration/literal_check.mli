(** The values of literals are known before the program runs, so their faults are reported then, in the words of the
    run. *)

open Core
module Ast = Dolphin_syntax.Ast

val value : Ast.expression -> value option
(** [value e] is the value of [e] if it is a number, also with a unit, a string, a truth value or null. *)

val all : Ast.expression list -> value list option
(** Their values, if all are literals. *)

val fault : builtin -> value list -> string option
(** [fault b xs] is the fault of [xs] as arguments of [b], if [b] is among those whose arguments are numbers and
    names only. *)

val fault_of_time : string -> Ast.expression -> string option
(** [fault_of_time what e] is the fault of [e] as a time for [what]. *)

val fault_of_rounds : Ast.expression -> string option
(** [fault_of_rounds e] is the fault of [e] as a number of rounds. *)

val fault_of_mission : string -> (string option * Dolphin_syntax.Ast.expression) list -> string option
(** [fault_of_mission setting arguments] is the fault of an item of a mission, as far as its arguments, each with its
    name if it has one, are literals: {!Mission_builder.literal_fault}. *)

val fault_of_pick : string -> value list -> string option
(** [fault_of_pick s xs] is the fault of [xs] as arguments of the setting [s] of [pick]. *)
