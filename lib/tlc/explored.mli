(** The explorer's state graph, as {!Printed_graph} has TLC's: labels with derivations, and ends of runs as transitions
    from a state to itself. *)

open Dolphin_semantics

val marks : Configuration.t -> string list
(** [marks c] is what is seen of [c]: ["ended: completed"], ["ended: completed, with tuples left"], ["ended: halted: ..."]
    and ["ended: failed: ..."], with the message, if it has; ["B a, b"]; ["A a: survey"]; ["N k:1 * 2"] for two such pairs, or
    ["N k:1, k:2 in order"], the oldest first, if order matters. *)

val graph : ?effects:bool -> Dolphin_explore.Reference.t -> Dolphin_lts.Graph.t
(** [graph ~effects space] is the graph of [space], with the same numbers of states. With [effects], which is false by
    default, a label has the transition's effects after it, as [LabelAndEffects] of [spec/DolphinChecking.tla] has. *)
