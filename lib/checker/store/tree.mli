(** A set of states as {!States} describes it, in less memory and more time: tree compression. Each distinct word is
    kept once, by its place in the state, and so is each distinct pair of the numbers of two words, each distinct pair
    of the numbers of two pairs, and so on; a state is the pair at the top. States differ from their neighbours in few
    words, so the set takes little more than the pairs at the top. *)

type t

val create : words:int -> t
val words : t -> int
val count : t -> int
val push : t -> int array -> parent:int -> fresh:(int -> int -> unit) -> unit
val flush : t -> fresh:(int -> int -> unit) -> unit
val find : t -> int array -> int
val load : t -> int -> int array -> unit
val parent : t -> int -> int
val bytes : t -> int
val bytes_to_grow : t -> by:int -> int
val bytes_to_rewrite : t -> int
val forget_waiting : t -> unit
val rewrite : t -> words:int -> (int array -> int array -> unit) -> t
