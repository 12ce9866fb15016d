(** Problems whose leaves are all alike, as tasks by name for any vehicle are: in time and memory by the leaves and
    the candidates, while other solvers need a matrix of both. *)

val solve : restricted:(int array -> Cotree.t) -> Part.candidates array -> int array -> int array option
(** [solve ~restricted candidates leaves] is the vehicle of each of [leaves], as {!Part.make} takes them, in the best
    allocation, if: all of [leaves] have the same candidates at the same costs; branches have no exclusion inside;
    there are vehicles enough for one each; and costs are 0, or all branches have equally many leaves. If not, [None].

    Any choice of one vehicle for each branch then costs what its vehicles cost, whichever has which. So the cheapest
    are best, of equal ones the first, and pick order gives the first branch the first of them. *)
