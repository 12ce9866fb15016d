(** Longest ways in a graph without cycles. *)

type 'edge graph
(** A graph without cycles, with what edges are known by. *)

val order : int -> (int -> int list) -> int list
(** [order n successors] is those of the vertices 0 to [n - 1] that 0 leads to, each before those that it leads to, but
    for one edge or more of each cycle. *)

val graph : int -> (int * int * 'edge) list -> 'edge graph option
(** [graph n edges] has the vertices 0 to [n - 1], and each of [edges] from the first to the second. [None] if a cycle
    is led to from 0. *)

val ways : 'edge graph -> ('edge -> int) -> int array * (int -> 'edge list)
(** [ways g length] is the length of the longest way from 0 to each vertex, or less than 0 for unreachable ones; and
    such a way to a vertex. Lengths are 0 or more, and a way with an edge of [max_int] is [max_int] long. *)
