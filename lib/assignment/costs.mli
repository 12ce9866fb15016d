(** Matrices of costs: whole numbers, not negative, or {!forbidden}. *)

val forbidden : int
(** The cost of forbidden pairs. Sums of allowed costs stay far below. *)

val add : int -> int -> int
(** [add a b] is [a + b], or {!forbidden} if either is. *)

type t = private { rows : int; columns : int; storage : storage }

(** The costs, in elements of 3, 4 or 8 bytes. *)
and storage

val of_array : rows:int -> columns:int -> int array -> t
(** [of_array ~rows ~columns costs] has the [costs], a flat array, row by row. *)

val make : rows:int -> columns:int -> (int -> int array -> unit) -> t
(** [make ~rows ~columns fill] has the rows that [fill row buffer] leaves in [buffer], which is as long as a row and is
    used again. It takes 3 bytes for each cost if the costs of no row differ by more than 16 km, 4 up to 4,000 km, else
    8; rows are filled again where the first width is too narrow. *)

val row : t -> int -> int array -> int array * int
(** [row costs number buffer] is the array that has the row, and the index of its first cost. The array may be [buffer],
    which is as long as a row. *)

val dearest : t -> int
(** The greatest cost that is allowed, or 0. *)
