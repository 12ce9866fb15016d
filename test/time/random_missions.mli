(** Random programs with durations, for tests of [dolphin time]: many execute copies of a task side by side, with plans
    that take the same time. *)

open Dolphin_environment
open Dolphin_time

type durations = Same | By_plan | By_vehicle  (** the vehicles for which it is alike *)

type program = Mission of string | Any of Dolphin_syntax.Ast.program

type case = program * (int * durations) * (string * Environment.options)
(** The number makes the durations; the environment has a name. *)

val case : case QCheck2.Gen.t
val print : case -> string
val options : case -> Clocked.options

val answering : Environment.options
(** Nothing fails. *)

val numbered : int -> string -> string -> string
(** [numbered n separator text] is [n] copies of [text], in which # is the number of the copy. *)

val batteries : Dolphin_scenario.Scenario.vehicle list
(** Of the vehicles of the programs, some of which charge. *)
