(** Formulas of linear temporal logic about the runs of a program. A position of a run is a state together with the
    transition that led to it. A run that ends or is stuck is extended by an endless stay in its last state, without
    transitions.

    A formula holds of the program if it holds of every path of its state graph that is fair (docs/explorer.md), or of
    every path: {!Search.fairness}. Propositions see every transition, so no reduction leaves out steps; vehicles that
    no proposition distinguishes may be exchanged. *)

open Dolphin_semantics

type t

val of_string : Core.program -> string -> (t, string) result
(** The error is one sentence. A formula may ask of 62 plans, with or without a vehicle, whether they run. *)

val to_string : t -> string
(** The text that {!of_string} read. *)

val propositions : t -> Proposition.t array
(** Each once. *)

val conditions : t -> Condition.t list
(** Those that it evaluates in states. *)

val names : t -> Core.vehicle -> bool
(** Whether some proposition {!Proposition.names} the vehicle. *)

val formula : t -> int Dolphin_ltl.Formula.t
(** The formula, of places in {!propositions}. *)
