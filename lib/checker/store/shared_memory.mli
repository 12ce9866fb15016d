(** Memory that processes share: it is made before a process is forked, has no name, and is gone once they all end.
    Words are read and written as of any {!Bigarray}; this module orders these accesses among processes. *)

type ('a, 'b) t = ('a, 'b, Bigarray.c_layout) Bigarray.Array1.t
type words = (int, Bigarray.int_elt) t
(** Words: OCaml's integers, 8 bytes each. *)

val map : ('a, 'b) Bigarray.kind -> int -> ('a, 'b) t
(** [map kind n] is [n] zeros. They take memory once they are written to, page by page: so [n] may be large. It is not
    given back but by {!unmap}, or when the processes end.
    @raise Out_of_memory if the system does not grant the addresses *)

val forget : ('a, 'b) t -> from:int -> length:int -> unit
(** [forget a ~from ~length] gives back the memory of these elements, in all processes. Words on pages shared with
    others keep their values, the rest are 0, if the system supports that. *)

val unmap : ('a, 'b) t -> unit
(** [unmap a] gives back all of [a], in this process: it has no elements then. *)

(** {1 Words}

    The writes of a process before it wrote a word by these are visible to a process that has read the word by these.
    No index is checked. *)

val read : words -> int -> int
(** [read a i] is word [i]. *)

val write : words -> int -> int -> unit
(** [write a i x] makes word [i] [x]. *)

val add : words -> int -> int -> int
(** [add a i n] adds [n] to word [i]; the result is its value before. *)

val swap : words -> int -> int -> int -> bool
(** [swap a i x y] is whether word [i] was [x]: then it is [y] now. *)

(** {1 The machine} *)

val machine_memory : unit -> int
(** Bytes. *)

val machine_cores : unit -> int
(** Those that this process may use. *)
