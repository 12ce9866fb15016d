(** A set of states as {!States} describes it, in less memory and more time: tree compression. Each distinct word is
    kept once, by its place in the state, and so is each distinct pair of the numbers of two words, each distinct pair
    of the numbers of two pairs, and so on; a state is the pair at the top. States differ from their neighbours in few
    words, so the set takes little more than the pairs at the top. *)

type t

val create : words:int -> t
(** [create ~words] is an empty set of vectors of [words] words. *)

val words : t -> int
(** As {!States.words}. *)

val count : t -> int
(** As {!States.count}. *)

val push : t -> int array -> parent:int -> fresh:(int -> int -> unit) -> unit
(** As {!States.push}. *)

val flush : t -> fresh:(int -> int -> unit) -> unit
(** As {!States.flush}. *)

val find : t -> int array -> int
(** As {!States.find}. *)

val load : t -> int -> int array -> unit
(** As {!States.load}. *)

val parent : t -> int -> int
(** As {!States.parent}. *)

val bytes : t -> int
(** As {!States.bytes}. *)

val bytes_to_grow : t -> by:int -> int
(** As {!States.bytes_to_grow}. *)

val bytes_to_rewrite : t -> int
(** As {!States.bytes_to_rewrite}, whatever the new number of words. *)

val forget_waiting : t -> unit
(** As {!States.forget_waiting}. *)

val rewrite : t -> words:int -> (int array -> int array -> unit) -> t
(** As {!States.rewrite}. *)
