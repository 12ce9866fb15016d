(** A set of states, each a vector of a fixed number of words, that never forgets. States are numbered from 0 in the
    order in which they come, so that the set is also the queue of a breadth-first search, and each knows the state it
    was first reached from. All that lives outside of OCaml's heap: as it is ({!Packed}), or in less memory and more
    time ({!Tree}). *)

type t

val create : compress:bool -> words:int -> t
(** [create ~compress ~words] is an empty set of vectors of so many words. The word [-1] may not be among them. *)

val words : t -> int
val count : t -> int

val push : t -> int array -> parent:int -> fresh:(int -> int -> unit) -> unit
(** [push t key ~parent ~fresh] adds the first words of [key], unless they are there, now or later, but before a
    {!flush}, and in
    the order of pushes. [parent] is the state that it was found from, and never less than at the push before. When it
    comes, [fresh] gets the number and the
    first word of each state that is new. *)

val flush : t -> fresh:(int -> int -> unit) -> unit
(** [flush t ~fresh] adds what has been pushed. *)

val find : t -> int array -> int
(** [find t key] is the number of state [key], or [-1]. *)

val load : t -> int -> int array -> unit
(** [load t i key] puts the words of state [i] into [key]. *)

val parent : t -> int -> int
(** [parent t i] is the [parent] that [i] was added with. *)

val bytes : t -> int
(** Memory in use outside of OCaml's heap. *)

val bytes_to_grow : t -> by:int -> int
(** [bytes_to_grow t ~by:n] is how much more it may take at once for the next [n] states. *)

val bytes_to_rewrite : t -> words:int -> int
(** [bytes_to_rewrite t ~words] is how much {!rewrite} may take beside what there is. *)

val forget_waiting : t -> unit
(** What has been pushed and not added is not: for when there is no memory. *)

val rewrite : t -> words:int -> (int array -> int array -> unit) -> t
(** [rewrite t ~words f] is the states of [t] in new words, under the same numbers: [f old fresh] puts the new words of
    [old] into [fresh], which is all 0. Different states must stay different, and nothing may
    wait to be added. [t] is used up. *)
