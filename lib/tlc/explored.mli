(** The explorer's state graph in the form of {!Printed_graph}: labels with derivations, and marks as transitions from a
    state to itself. *)

open Dolphin_semantics

val marks : Configuration.t -> string list
(** [marks c] is the visible part of [c]. Its end, if it has ended: ["ended: completed"], ["ended: completed, with
    tuples left"], ["ended: halted: MESSAGE"], ["ended: failed: MESSAGE"] or ["ended: interrupted"]. B: ["B a, b"].
    A: ["A a: survey"]. N: ["N k:1 * 2"] for two such pairs, or ["N k:1, k:2 in order"], the oldest first, if their
    order matters. *)

val graph : ?effects:bool -> Dolphin_explore.Reference.t -> Dolphin_lts.Graph.t
(** [graph ~effects space] is the graph of [space], with the same numbers of states. With [effects], which is false by
    default, a label has the transition's effects after it, as [LabelAndEffects] of [spec/DolphinChecking.tla] has. *)
