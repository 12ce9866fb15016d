(** Runs found by the labels of their transitions, such as those that another tool shows. *)

open Dolphin_semantics
open Dolphin_environment

type state = Configuration.t * Environment.t
(** A configuration, with the environment's memory. *)

val start : Core.program -> state
(** The start of every run. *)

val follow : Environment.options -> Core.program -> World.t -> state -> string list -> (state * Transition.t list) list
(** [follow o p w s labels] is the states that can be reached from [s] by transitions with these labels, as
    [Label.pp] prints them, each with one run to it. The result is empty if no run has these labels, and has several
    members if several transitions share a label. *)

val back : Environment.options -> Core.program -> World.t -> state -> state -> Transition.t option
(** [back o p w s s'] is the first transition from [s] to [s'], whatever its label. *)
