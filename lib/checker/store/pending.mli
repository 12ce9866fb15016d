(** States that wait to be added to a set, in order. Looking for a state costs two reads of memory, of the table and of
    the state found there, and little else. A processor waits for many reads at once if they do not depend on each
    other: so the table is read for all that wait, then the states, and only then are they added, from the caches. *)

(** State [k] has its words in [keys] from [k * words] on, its {!Slot.hash} and its parent. *)
type t = private { words : int; keys : int array; hashes : int array; parents : int array; mutable length : int }

val most : int
(** The limit on waiting states. *)

val create : words:int -> t
(** [create ~words] is for vectors of [words] words; none waits. *)

val add : t -> int array -> parent:int -> bool
(** [add w key ~parent] adds the state in the first words of [key], and is whether {!most} wait now: then they are to be
    taken, and {!clear} called, before another one comes. *)

val clear : t -> unit
(** Takes all of them away. *)

val read_slots : t -> Slot.table -> int -> unit
(** [read_slots w table mask] reads the slot at which the search for each of them will start, in a table of [mask + 1]
    slots. *)
