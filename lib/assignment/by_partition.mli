(** Branches that need several vehicles. If the branches of the root exclude each other, and have no exclusion inside,
    all that is hard is which rows of a branch share a vehicle. Once that is settled for all branches, the rest is one
    assignment problem; hence the search is through the partitions of the branches' rows. *)

val improve : Partial_assignment.t -> int array -> int array * bool
(** [improve search allocation] is the best of the allocations with as many vehicles as [allocation], which has the
    fewest, and whether all of them have been considered. They have not if the part is not as above, if a branch has
    more than five rows, or if the steps come to the search's ceiling; the allocation is then the best of those that
    have, or [allocation]. *)
