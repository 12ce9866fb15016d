(** A set of states as {!States} describes it, uncompressed: 8 bytes a word, a quarter of a byte for the parent, and
    11 to 23 bytes in the hash table. The table holds states of one word themselves, which is faster than their
    numbers, until the number of a state is asked for the first time; then it is rebuilt with numbers. *)

type t

val create : words:int -> t
(** [create ~words] is an empty set of vectors of [words] words. *)

val words : t -> int
(** As {!States.words}. *)

val count : t -> int
(** As {!States.count}. *)

val push : t -> int array -> parent:int -> fresh:(int -> int -> unit) -> unit
(** Pushes are processed in batches, which is much faster than one by one once the set has outgrown the processor's
    caches. *)

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

val bytes_to_rewrite : t -> words:int -> int
(** As {!States.bytes_to_rewrite}. *)

val forget_waiting : t -> unit
(** As {!States.forget_waiting}. *)

val rewrite : t -> words:int -> (int array -> int array -> unit) -> t
(** As {!States.rewrite}. *)

(** {1:disk States elsewhere} *)

val parents : t -> Parents.t
(** The parents of its states, for a set that takes its states over. *)

val room : t -> int
(** How many states there may be, whatever waits besides, before it takes more memory; 1 at least. *)

val table : t -> Slot.table
(** Its hash table. *)

val clear : t -> unit
(** [clear t] takes all states away, and keeps the memory. The parents of those that come have nothing to do with
    {!parents} before. *)

val members : t -> Bytes.t -> first:int -> n:int -> (int -> unit) -> unit
(** [members t b ~first ~n f] calls [f] with the number of each of [n] vectors that is a member: those in [b] from the
    one at place [first] on, with 8 bytes a word. [n] is at most {!Pending.most}. Nothing may wait to be added. *)
