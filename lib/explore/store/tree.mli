(** A set of states as {!Packed} is one, in less memory and more time: tree compression. Of a state's words, each
    different one
    is kept once, and so is each different pair of numbers of words, of such pairs, and so on; a state is the pair at
    the
    top. States differ from their neighbours in few words, so that the set is little more than the tops. *)

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
