(** Which propositions of a formula hold where, in encoded states: the labelling of the state graph. Memoised by the
    number of the configuration or of the shared state, and by which plans run. *)

open Dolphin_semantics

type t

val create : Core.program -> World.t -> Temporal.t -> t
(** For one state space. *)

val monitor : t -> Dolphin_ltl.Monitor.t
(** Of runs that violate the formula. *)

val valuations : t -> Valuation.t
(** The numbers of the valuations that the monitor's letters are. *)

val observer : t -> Observer.t
(** Its actions are those of the {!valuations}; its [valuation] raises {!Valuation.Broken}. *)
