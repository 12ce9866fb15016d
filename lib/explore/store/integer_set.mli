(** A set of numbers of at most 63 bits, itself numbered from 0 in the order in which they come, that never forgets and
    takes little
    memory: as many bytes a number as the largest one needs, and 5 to 6 in the table that finds it. All of it is
    outside of
    OCaml's heap. *)

type t

val create : unit -> t
val count : t -> int

val add : t -> int -> int
(** [add t x] is [i] if [x] is number [i], and [-1 - i] if it is new. *)

val find : t -> int -> int
(** [find t x] is the number of [x], or [-1]. *)

val get : t -> int -> int
(** [get t i] is number [i]. *)

val bytes : t -> int

val bytes_to_grow : by:int -> t -> int
(** How much more it may take at once for so many more numbers. *)

val renew : t -> (int -> int) -> unit
(** [renew t f] puts [f x] in the place of each number [x], from 0 on; different numbers must stay different. *)

(** {1:reading Reading ahead}

    A look-up waits for two reads of memory. The processor waits for those of many look-ups at once if they are done
    before any of
    them is needed. *)

val read_table : t -> int -> int
(** [read_table t x] reads where [add t x] will start, and is anything. *)

val read_number : t -> int -> int
(** [read_number t x] reads the number found there, and is anything. *)
