(** Strong and weak bisimilarity of state graphs, by labels and by how runs end. *)

val equivalent :
  ?named:(Dolphin_semantics.Label.t -> string) ->
  ?observed:(Dolphin_semantics.Configuration.t -> string) ->
  Graph.t -> Graph.t -> bool
(** [equivalent a b] is whether the initial states of [a] and [b] are strongly bisimilar: whatever one can do, the
    other can, with the same label, to states of which the same holds; and ended runs ended alike, message included.
    Bisimilar states moreover agree on the [observed] part, by default nothing. Labels are the same if [named] makes
    them equal, by default if they read the same. *)

val shared : Dolphin_semantics.Configuration.t -> string
(** [shared c] is the store, A, B and N of [c], in a canonical text: the part of each other that parts of a task can
    see. *)

val weakly_equivalent : Graph.t -> Graph.t -> bool
(** [weakly_equivalent a b] is whether the initial states of [a] and [b] are weakly bisimilar where only starts,
    ends and failures of vehicles' tasks and how runs end are seen: before and behind what is seen of one, the other may
    take any number of other steps. *)

val classes : Graph.t -> int
(** [classes a] is the number of states of [a] that differ from one another. *)
