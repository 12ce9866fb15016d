(** Sets of integers that only grow. Each member has an index, from 0 in order of insertion. A member takes as many
    bytes as the largest one of 65,536 with indices beside its own needs, and 5 to 6 bytes in the hash table. All of it
    lives outside of OCaml's heap. *)

type t

val create : unit -> t
(** The empty set. *)

val count : t -> int
(** The number of members. *)

val add : t -> int -> int
(** [add t x] is [i] if [x] is member [i] already, and [-1 - i] if it becomes member [i] now. *)

val find : t -> int -> int
(** [find t x] is the index of [x], or [-1] if [x] is not a member. *)

val get : t -> int -> int
(** [get t i] is member [i]. *)

val bytes : t -> int
(** Memory in use. *)

val bytes_to_grow : by:int -> t -> int
(** [bytes_to_grow ~by:n t] is the most memory that adding [n] members may take at once. *)

val renew : t -> (int -> int) -> unit
(** [renew t f] replaces each member [x] by [f x], in order of indices, which stay. [f] must be injective. *)

(** {1:prefetching Prefetching}

    A look-up waits for two reads of memory. The processor overlaps the reads of many look-ups if they are issued
    before the first result is needed. The results of these two functions mean nothing. *)

val read_table : t -> int -> int
(** [read_table t x] reads the slot at which [add t x] will start. *)

val read_number : t -> int -> int
(** [read_number t x] reads the member found there. *)
