(** Which vehicle does which part of a task: the combinatorial core of allocation, without vehicles or tasks.

    A task is seen as a tree whose leaves want one vehicle each. {!solve} gives every leaf a vehicle so that leaves in
    different branches of a {!Disjoint} node have different vehicles; other leaves may share. Among the allocations
    that do so, it gives the best one, in this order:

    + the fewest distinct vehicles;
    + the least sum of the leaves' costs, each rounded to a millimetre, so that ties are exact;
    + pick order: the lexicographically least vector of vehicles, over the leaves from left to right.

    {1:cost What it costs to compute}

    Let [n] be the number of leaves, [m] of vehicles. In general the question is hard: whether a feasible allocation
    exists is list colouring of a cograph, which is NP-complete, and to share as few vehicles as possible is minimum
    hitting set even without any [Disjoint].

    Polynomial, in [O(n² m)] at worst and far less as a rule, and in [3 n m] bytes for distances of kilometres, are the
    trees that programs have: [Disjoint] branches without a [Disjoint] inside, whose branches can, all at once, be
    served by one vehicle each. The number of vehicles is then that of the branches, the rest is assignment of least
    cost, and pick order is decided on the dual solution. A problem also falls apart, exactly, where candidates do not
    overlap: parts that want boats and parts that want aircraft are solved separately; if all leaves of such a tree are
    alike, the cheapest vehicles suffice; and leaves that may share and have the same candidates at the same costs are
    one.

    The rest goes through branch and bound, with assignment problems on the cliques of the tree as bounds; if
    branches that exclude each other need several vehicles each, over the ways to split them up. Whether an
    allocation exists is searched to the end, however long. Improvements of a found allocation are limited to
    {!effort} steps; beyond, the best so far is given, and {!type-solution.proven} reports it.

    {[
      open Dolphin_assignment

      (* Two surveys side by side; vehicle 0 is near both, vehicle 1 can do the second one only. *)
      let first = Assignment.listed [ (0, 100.) ] and second = Assignment.listed [ (0, 50.); (1, 900.) ]

      let () =
        let one_after_the_other = Assignment.Shared [ Leaf first; Leaf second ] in
        let side_by_side = Assignment.Disjoint [ Leaf first; Leaf second ] in
        assert (Assignment.solve ~vehicles:2 one_after_the_other = Ok [| 0; 0 |]);
        assert (Assignment.solve ~vehicles:2 side_by_side = Ok [| 0; 1 |])
    ]} *)

(** The shape of a task. Nodes without children need no vehicle. *)
type 'a tree =
  | Leaf of 'a
  | Disjoint of 'a tree list  (** branches of [|]: no vehicle in two branches *)
  | Shared of 'a tree list  (** parts of [>>], branches of [allOf] and [oneOf]: may share, and prefer to *)

(** The vehicles that may do a leaf. Leaves that share one array of [vehicles] are looked through faster. *)
type leaf = {
  vehicles : int array;  (** each by its place in pick order from 0, ascending, each once *)
  metres : (int -> float) option;
  (** The cost of each of them: metres, not negative; more than 10⁹ counts as 10⁹, an infinite distance included. It is
      asked for as often as needed, and not kept. [None]: 0 for each. *)
}

val listed : (int * float) list -> leaf
(** [listed candidates] is the leaf of these vehicles, in any order, with their costs. Of a vehicle that is listed twice
    the lower cost counts. *)

(** Why there is no allocation. Leaves are numbered from 0, left to right. *)
type failure =
  | No_candidate of int  (** The first leaf without any candidate. *)
  | Conflict of { leaves : int list; vehicles : int list }
  (** These leaves, ascending, cannot all be served by their candidates, [vehicles], ascending. If every two of
      the leaves exclude each other, the [vehicles] are too few, and if any one leaf is left out they are enough.
      In other cases the leaves are as few as could be found by leaving out one after the other. *)

type solution = {
  vehicles : int array;  (** the vehicle of each leaf *)
  proven : bool;  (** whether it is the best one; otherwise it is feasible, and good *)
}

val effort : int
(** The number of elementary steps that {!solve} spends on bettering a feasible allocation: about a second. *)

val solve : vehicles:int -> leaf tree -> (int array, failure) result
(** [solve ~vehicles tree] is [(solve_within ~effort ~vehicles tree).vehicles]. *)

val solve_within : effort:int -> vehicles:int -> leaf tree -> (solution, failure) result
(** [solve_within ~effort ~vehicles tree] is the best allocation of [vehicles] vehicles to the leaves of [tree], or the
    best that [effort] steps have found, or the reason why there is none. It depends on its arguments only: steps are
    counted, time is not. Trees may be deep: the stack does not grow with the nesting.

    @raise Invalid_argument if a vehicle is not from 0 to [vehicles - 1], if the vehicles of a leaf do not ascend, or if
    a cost is negative or not a number. *)

val pp_failure : Format.formatter -> failure -> unit
(** One sentence without a full stop, about leaves and vehicles by number. *)
