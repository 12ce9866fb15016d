(** A problem cut down to the parts that have to be decided together: leaves whose candidates overlap, each group of
    leaves that are one as a row, each vehicle that any of them may take as a column.

    Rows and columns keep the order of leaves and vehicles, so that what comes first by number also comes first in pick
    order. Costs are whole millimetres. *)

(** The vehicles that may serve a leaf. *)
type candidates = private {
  vehicles : int array;  (** ascending, each once *)
  cost : (int -> int) option;  (** by vehicle; [None]: 0 for each *)
}

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

val candidates : vehicles:int -> int array -> (int -> float) option -> candidates
(** [candidates ~vehicles listed metres] is those of a leaf, as {!Assignment.leaf} has them.

    @raise Invalid_argument as {!Assignment.solve_within} does; for a cost when it is asked for. *)

val equal_candidates : candidates -> candidates -> bool
(** Whether these are the same vehicles at the same costs. *)

val cost_nothing : candidates -> bool
(** Whether all costs are 0. *)

val visit : (int -> int -> unit) -> candidates -> unit
(** [visit f candidates] is [f vehicle cost] for each of them, ascending. *)

val vehicles_of : candidates array -> int array -> int array
(** [vehicles_of candidates leaves] is the vehicles of [leaves], ascending, each once. *)

val by_vehicle : int array -> int array
(** [by_vehicle columns] is, by vehicle, its place in [columns], ascending; -1 if it has none. *)

val components : vehicles:int -> candidates array -> int array list
(** [components ~vehicles candidates] is the leaves in parts, so that no vehicle is a candidate in two of them. Leaves
    ascend in each part, and parts by their first leaf. Every leaf has a candidate. *)

val make : restricted:(int array -> Cotree.t) -> candidates array -> int array -> t
(** [make ~restricted candidates leaves] is the problem of [leaves] alone, ascending, where [candidates] are by leaf
    of the whole problem, and [restricted] is the {!Cotree.restriction} of it. Leaves are one if they may share and
    have the same candidates at the same costs. *)
