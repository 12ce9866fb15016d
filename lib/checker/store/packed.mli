(** A set of states as {!States} describes it, uncompressed: 8 bytes a word, a quarter of a byte for the parent, and
    11 to 23 bytes in the hash table. The table holds states of one word themselves, which is faster than their
    numbers, until the number of a state is asked for the first time; then it is rebuilt with numbers. *)

type t

val create : words:int -> t
val words : t -> int
val count : t -> int

val push : t -> int array -> parent:int -> fresh:(int -> int -> unit) -> unit
(** Pushes are processed in batches, which is much faster than one by one once the set has outgrown the processor's
    caches. *)

val flush : t -> fresh:(int -> int -> unit) -> unit
val find : t -> int array -> int
val load : t -> int -> int array -> unit
val parent : t -> int -> int
val bytes : t -> int
val bytes_to_grow : t -> by:int -> int
val bytes_to_rewrite : t -> words:int -> int
val forget_waiting : t -> unit
val rewrite : t -> words:int -> (int array -> int array -> unit) -> t

(** {1:disk States elsewhere} *)

val parents : t -> Parents.t

val room : t -> int
(** How many states there may be, whatever waits besides, before it takes more memory; 1 at least. *)

val table : t -> Slot.table

val clear : t -> unit
(** [clear t] takes all states away, and keeps the memory. The parents of those that come have nothing to do with
    {!parents} before. *)

val members : t -> Bytes.t -> first:int -> n:int -> (int -> unit) -> unit
(** [members t b ~first ~n f] calls [f] with the number of each of [n] vectors that is a member: those in [b] from the
    one at place [first] on, with 8 bytes a word. [n] is at most {!Waiting.most}. Nothing may wait to be added. *)
