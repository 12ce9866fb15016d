(** Random walks through a program's states. *)

open Dolphin_semantics

(** One transition, with its source. *)
type step = { before : Configuration.t; transition : Transition.t }

val run : choices:int list -> Core.program -> World.t -> step list
(** [run ~choices p w] is a run of [p], each choice among all that may happen (own steps, awaited events, failures;
    seldom Ctrl-C) settled by the next of [choices], until they are used up or the run has ended. It depends on its
    arguments only. *)

val choices : int list QCheck2.Gen.t
(** Up to 80 of them. *)
