(** The explorer's state graph in the form of {!Printed_graph}: labels with derivations, and marks as transitions from a
    state to itself. *)

val graph : ?effects:bool -> Dolphin_explore.Reference.t -> Dolphin_lts.Graph.t
(** [graph ~effects space] is the graph of [space], with the same numbers of states. With [effects], which is false by
    default, a label has the transition's effects after it, as [LabelAndEffects] of [spec/DolphinChecking.tla] has. *)
