(** The state of a search through the allocations of a part: the columns of the rows so far, and the columns left to
    the others. Mutable: {!assign} and {!unassign} change it and change it back. A column is in use if a row has it. *)

type t = {
  part : Part.t;
  rows : int;
  width : int;  (** how many columns *)
  exclusions : int array array;  (** by row, as {!Cotree.exclusions} *)
  cliques : int array array;  (** a partition of the rows, as {!Cotree.cliques} *)
  below : int list array;  (** by node of the cotree, rows *)
  free : bool array;  (** by node, as {!Cotree.is_free} *)
  alike : int array;  (** by column, the least column with the same costs *)
  spent : int ref;  (** steps so far, in this search and those before *)
  assigned : int array;  (** by row, -1 for none *)
  uses : int array;  (** by column, by how many rows *)
  blocked : int array;  (** by row and column, how many assigned rows forbid the pair *)
  mutable used : int;  (** how many columns are in use *)
  mutable limit : int;  (** on columns in use *)
  mutable ceiling : int;  (** on steps *)
}

val make : spent:int ref -> Part.t -> t
(** [make ~spent part] has nothing assigned and no limits. Its steps are added to [spent]. *)

(** {1:effort Effort} *)

exception Exhausted
(** The steps are more than the ceiling. *)

val check : t -> unit
(** @raise Exhausted if that is so. *)

(** {1:assign Assigning} *)

val is_available : t -> int -> int -> bool
(** [is_available search row column] is whether [row] has [column], or could get it: it may take it, no other excludes
    that, and the limit on columns in use allows it. *)

val assign : t -> int -> int -> unit
(** [assign search row column] gives [column] to [row], which has none. *)

val unassign : t -> int -> unit
(** [unassign search row] takes the column of [row], which has one. *)

val release : t -> unit
(** Unassigns all rows. *)

val domain_sizes : t -> int array
(** By row, how many columns are available. *)

(** {1:allocations Whole allocations}

    These are arrays of columns, by row. *)

val cost_of : t -> int array -> int array -> int
(** [cost_of search weights allocation] is the sum of [weights], which are by row and column. *)

val count_of : int array -> int
(** How many columns are in use. *)

val is_feasible : t -> int array -> bool
(** Whether no two rows that exclude each other have the same column. *)
