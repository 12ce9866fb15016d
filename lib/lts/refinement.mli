(** Partition refinement: blocks of states are split, round by round, until all states of a block have the same
    signature, which lists the labels by which they go to each block.

    Block 0 is there at first; rounds are numbered from 1. After round [k] two states are in one block exactly if they
    are bisimilar for [k] steps.

    When a block is split, its largest part keeps its number, and only states with a transition to one of the other
    parts are visited again. So a state's block changes at most [log n] times, and the whole takes
    [O(d m log n)] for [n] states, [m] transitions and [d] transitions per state. *)

type t

val create : ?counting:bool -> Graph.t -> t
(** [create g] has all states of [g] in block 0. Signatures are sets or, if [counting], multisets: how many transitions
    with a label go to a block matters. *)

val copy : t -> t
(** A copy that is refined independently. *)

val run : t -> unit
(** Refines until nothing changes. *)

val separate_few : t -> int list -> unit
(** [separate_few r states], after [run r], parts [states], which are in one block, from the others of that block; as
    a round of its own. It takes time for the states that move and those that lead to them. *)

val block : t -> int -> int
(** [block r s] is the block of state [s]. *)

val block_after : t -> round:int -> int -> int
(** [block_after r ~round s] is the block that state [s] was in after that round, in [O(log n)]. *)

val blocks : t -> int
(** How many there are; they are numbered from 0. *)

val rounds : t -> int
(** How many there were so far. *)

val size : t -> int -> int
(** The number of states in a block. *)

val iter_block : t -> int -> (int -> unit) -> unit
(** The states in a block. *)

val member : t -> int -> int
(** A state of a block. *)

val parted : t -> int -> int -> int
(** [parted r b c] is the round that parted the states of block [b] from those of block [c], which is another. It takes
    [O(log n)]. *)
