(** Bounds that no completion of a search can better: lower bounds on its weight and on its vehicles. Each adds its
    steps to those of the search. *)

val match_clique : Partial_assignment.t -> int array -> (int -> int -> int) -> (int array, int list) result
(** [match_clique search clique weight] is the columns of the rows of [clique], by their place in it, all different and
    of least [weight row column], which may be {!Matching.forbidden}; or rows of it that have too few columns. *)

val nothing_matched : Partial_assignment.t -> int array
(** For {!relax}: no row has a column. *)

val relax : Partial_assignment.t -> int array -> int array -> (unit, int list) result
(** [relax search weights matched] changes [matched] to the columns with which the cliques cost least, each for
    itself, among the available ones. Rows in different cliques may still exclude each other, so that the cost is a
    bound only. [matched] was so changed with the same weights and fewer rows assigned, or is {!nothing_matched}. The
    error is rows with too few vehicles. *)

val least_vehicles : Partial_assignment.t -> int array -> int
(** [least_vehicles search sizes] is a number of columns: every completion of the present assignment has at least as
    many in use. [sizes] are {!Partial_assignment.domain_sizes}, and {!relax} has found no error. *)
