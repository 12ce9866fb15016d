(** Cycles of a graph that meet each of several sets of its nodes. Nodes are numbers from 0. *)

(** A graph by its successors, each with the label of the arrival in it. *)
type 'label graph = {
  successors : int -> (int * 'label) list;
  sets : int;  (** how many sets there are *)
  is_in : int -> int -> bool;  (** [is_in i k] is whether node [i] is in set [k], from 0 *)
}

type component
(** Nodes that each can reach all, itself included, in one step or more; each set has some of them. *)

val find : ?tick:(unit -> unit) -> 'label graph -> int list -> component option
(** [find g starts] is such a component among those reachable from [starts], if any, by the algorithm of Couvreur
    (1999). Of a component's nodes it may be only some. It takes no stack, a bit for each node that is reached, and
    some words for each that may still turn out to be on a cycle. [tick] is called at each new node. *)

val on_cycles : ?tick:(unit -> unit) -> 'label graph -> int list -> int -> bool
(** [on_cycles g starts] is the nodes, among those reachable from [starts], that can reach themselves in one step or
    more, whatever sets their cycles meet. All nodes are visited when [starts] is given. Time, space and [tick] are as
    of {!find}. *)

val first : component -> int
(** The smallest node. *)

val mem : component -> int -> bool
(** [mem c i] is whether node [i] is in [c]. *)

val around : 'label graph -> component -> int -> (int * 'label) list
(** [around g c i] is a way from node [i] of [c] back to [i], not empty, that meets all sets: arrivals in nodes of [c].
    It goes by the shortest way from one set to the next. *)

val way :
  'label graph -> within:(int -> bool) -> goal:(int -> bool) -> (int * 'label) list -> (int * 'label) list option
(** [way g ~within ~goal firsts] is a shortest way, not empty, that begins with one of the arrivals [firsts], and ends
    in a node with [goal], all of its nodes having [within]. *)
