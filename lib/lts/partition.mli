(** Strong bisimilarity, and the smallest graph that is strongly bisimilar to a given one. *)

type t

val strong : Graph.t -> t
(** [strong g] parts the states of [g], reachable or not, into blocks of strongly bisimilar ones. For the time it takes
    see {!Refinement}. *)

val blocks : t -> int
(** The number of blocks. They are numbered from 0 in the order of their least states. *)

val block : t -> int -> int
(** [block p s] is the block of state [s]. States have the same block exactly if they are strongly bisimilar. *)

val quotient : Graph.t -> t -> Graph.t
(** [quotient g (strong g)] has the blocks as states, and a transition between two blocks where there is one between
    states of theirs. It is strongly bisimilar to [g], and no two of its states are strongly bisimilar. A state's text
    is that of the least state in the block. *)

val minimal : Graph.t -> Graph.t
(** [minimal g] is the smallest graph that is strongly bisimilar to [g], without the states that cannot be reached,
    numbered breadth first. *)
