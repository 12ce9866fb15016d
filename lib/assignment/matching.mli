(** Assignment of least cost: each row of a matrix gets a column of its own. *)

val forbidden : int
(** [Costs.forbidden]. *)

(** A matching of all rows, with a proof that it costs least. *)
type t = private {
  column_of : int array;  (** by row *)
  row_of : int array;  (** by column, -1 for none *)
  dual : int array;  (** by column: not positive, 0 for columns without row *)
}

val solve : spent:int ref -> Costs.t -> (t, int list) result
(** [solve ~spent costs] is a matching of all rows of least cost; or rows, ascending, that have fewer
    columns, although all but any one of them can be matched. Adds its steps to [spent]. *)

val in_pick_order : Costs.t -> t -> int array
(** [in_pick_order costs m] is the column of each row in the lexicographically least of the matchings
    that cost as little as [m], which is a solution of [costs]. It takes a bit for each pair. *)
