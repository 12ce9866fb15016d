(** Good allocations without a search. All leave the search with nothing assigned, as they find it. *)

val sharing_weights : Partial_assignment.t -> int array
(** By row and column, weights that make every clique prefer the same vehicles: those that can serve most rows. *)

val greedy : Partial_assignment.t -> int array -> int array option
(** [greedy search weights] is a feasible allocation, found clique by clique with few further vehicles, those of
    least [weights], if that works out. *)

val polish : Partial_assignment.t -> int array -> int array
(** [polish search allocation] is a feasible allocation that costs no more than [allocation], and uses no more
    vehicles. *)
