(** A problem cut down to the parts that have to be decided together: leaves whose candidates overlap, each group of
    leaves that are one as a row, each vehicle that any of them may take as a column.

    Rows and columns keep the order of leaves and vehicles, so that what comes first by number also comes first in pick
    order. Costs are whole millimetres. *)

type candidates = (int * int) array
(** The vehicles that may serve a leaf, ascending, each once, and their costs. *)

type t = private {
  cotree : Cotree.t;  (** of the rows *)
  groups : int array;  (** by row, the first of the leaves that are one, ascending *)
  members : int list array;  (** by row, these leaves *)
  columns : int array;  (** by column, the vehicle, ascending *)
  cost : int array;  (** by row and column, of the whole group; or {!Matching.forbidden} *)
}

(** The knowledge about a part. *)
type outcome =
  | Found of int array  (** an allocation: the column of each row *)
  | Impossible of int list option  (** leaves that cannot all be served, if any are known to be the cause *)
  | Undecided

val candidates : vehicles:int -> (int * float) array -> candidates
(** [candidates ~vehicles listed] is [listed], vehicles with metres as in {!Assignment.leaf}, in order.

    @raise Invalid_argument as {!Assignment.solve_within} does. *)

val components : vehicles:int -> candidates array -> int array list
(** [components ~vehicles candidates] is the leaves in parts, so that no vehicle is a candidate in two of them. Leaves
    ascend in each part, and parts by their first leaf. Every leaf has a candidate. *)

val make : restricted:(int array -> Cotree.t) -> candidates array -> int array -> t
(** [make ~restricted candidates leaves] is the problem of [leaves] alone, ascending, where [candidates] are by leaf
    of the whole problem, and [restricted] is the {!Cotree.restriction} of it. Leaves are one if they may share and
    have the same candidates at the same costs. *)
