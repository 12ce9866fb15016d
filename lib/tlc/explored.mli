(** The explorer's state graph, as {!Printed_graph} has TLC's: labels with derivations, and ends of runs as transitions
    from a state to itself. *)

open Dolphin_semantics

val ending : Configuration.t -> string
(** How a configuration has ended: ["completed"], ["completed, with tuples left"], ["halted: ..."] and
    ["failed: ..."] with the message; [""] if it has not. *)

val graph : Dolphin_explore.Reference.t -> Dolphin_lts.Graph.t
(** Its states have the numbers that they have there. *)
