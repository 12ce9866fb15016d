(** Slots of the hash tables that sets of states have. A slot is 0 if it is free. If the table is {e bare} it is a state
    of one word, plus 1; otherwise an {e entry}: the number of a state, plus 1, below the high bits of its hash. *)

type table = (int, Bigarray.int_elt, Bigarray.c_layout) Bigarray.Array1.t
(** The slots of a table, a power of two. *)

val most : int -> int
(** [most n] is how many states a table of [n] slots may have. *)

val hash : words:int -> int array -> int
(** [hash ~words key] is of the first [words] words of [key]. Its low bits choose the slot. *)

(** {1 Entries} *)

val number_mask : int
(** The bits of an entry that have the number plus 1. *)

val entry : int -> int -> int
(** [entry h i] is the one of state [i], whose hash is [h]. *)

val tag : int -> int
(** [tag h] is the bits of the hash [h] that its entry has, in their place. *)

val is_tagged : int -> int -> bool
(** [is_tagged h e] is whether [e] may be the entry of a state whose hash is [h]. *)

val number : int -> int
(** [number e] is the number in the entry [e], or -1 of a free slot. *)

(** {1 Bare tables} *)

val find_bare : table -> int -> int -> int -> int
(** [find_bare table mask x slot] is the first slot from [slot] on that is [x] or free, in a table of [mask + 1] slots,
    some of which are free. *)
