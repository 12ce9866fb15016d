(** Assignment of least cost: each row of a matrix gets a column of its own.

    A matrix is a flat array, row by row. Costs are whole numbers, not negative, or {!forbidden}. *)

val forbidden : int
(** The cost of forbidden pairs. Sums of allowed costs stay far below. *)

val add : int -> int -> int
(** [add a b] is [a + b], or {!forbidden} if either is. *)

(** A matching of all rows, with a proof that it costs least. *)
type t = private {
  column_of : int array;  (** by row *)
  row_of : int array;  (** by column, -1 for none *)
  dual : int array;  (** by column: not positive, 0 for columns without row *)
}

val solve : spent:int ref -> rows:int -> columns:int -> int array -> (t, int list) result
(** [solve ~spent ~rows ~columns cost] is a matching of all rows of least cost; or rows, ascending, that have fewer
    columns, although all but any one of them can be matched. Adds its steps to [spent]. *)

val in_pick_order : rows:int -> columns:int -> int array -> t -> int array
(** [in_pick_order ~rows ~columns cost m] is the column of each row in the lexicographically least of the matchings
    that cost as little as [m], which is a solution of [cost]. *)
