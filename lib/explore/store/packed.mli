(** A set of states as {!States} has it, each state as it is: 8 bytes a word, a quarter of a byte for where it came
    from, and 11 to 23 in the table that finds it. As long as nobody asks for the number of a state of one word, the
    table has the states themselves, which is faster than their numbers; it is laid out anew at the first such
    question. *)

type t

val create : words:int -> t

val words : t -> int
val count : t -> int

val add : t -> int array -> parent:int -> int
(** [add t key ~parent] is [i] if the first words of [key] are state [i], and [-1 - i] if that state is new. *)

val push : t -> int array -> parent:int -> fresh:(int -> int -> unit) -> unit
(** This is faster by far than {!add} once the set has outgrown the processor's caches. *)

val flush : t -> fresh:(int -> int -> unit) -> unit
val find : t -> int array -> int
val load : t -> int -> int array -> unit
val parent : t -> int -> int
val bytes : t -> int
val bytes_to_grow : t -> by:int -> int
val bytes_to_rewrite : t -> words:int -> int
val forget_waiting : t -> unit
val rewrite : t -> words:int -> (int array -> int array -> unit) -> t
