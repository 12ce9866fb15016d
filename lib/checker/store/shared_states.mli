(** A set of states as {!States} describes it, which processes share: each of [workers] of them, forked after
    {!of_packed}, adds states at the same time, and each state is added once. There is one hash table for all; a slot
    is taken by compare-and-swap. Each worker appends the states that it adds to a segment of its own. So numbers are
    not given in order of insertion, and some are left out: {!iter} knows which there are. Those of worker 0 go on
    from those that were there before. 8 bytes a word, little more than one for the parent, and 11 to 23 in the
    table. *)

type t

val of_packed : Packed.t -> workers:int -> t
(** [of_packed s ~workers] is the states of [s] with the same numbers and parents, as worker 0 sees them. Nothing may
    wait to be added.
    @raise Out_of_memory if the system does not grant the addresses *)

val become : t -> int -> unit
(** [become t w] makes this process worker [w]. *)

val words : t -> int
(** As {!States.words}. *)

val count : t -> int
(** All that have been added by a {!flush} that has ended. *)

val is_full : t -> bool
(** Whether the table has to grow before more is added. *)

val when_full : t -> (t -> unit) -> unit
(** [when_full t f] makes [f] be called, in place of {!grow_alone}, before states are added to a table that {!is_full},
    which must not be full then. *)

val push : t -> int array -> parent:int -> fresh:(int -> int -> unit) -> unit
(** As {!States.push}; another worker may add the same state first. *)

val flush : t -> fresh:(int -> int -> unit) -> unit
(** As {!States.flush}, for the states that this worker has pushed. *)

val grow_alone : t -> unit
(** Makes the table larger; no other process uses it meanwhile. *)

val begin_growing : t -> unit
(** First one worker calls this, then each of them {!fill_part}, and none uses the table until all have. *)

val fill_part : t -> unit
(** Puts this worker's share of the states into the table that {!begin_growing} has made. *)

val find : t -> int array -> int
(** As {!States.find}, once the other workers are gone. *)

val load : t -> int -> int array -> unit
(** As {!States.load}, of any worker's state. *)

val parent : t -> int -> int
(** As {!States.parent}, of any worker's state. *)

val bytes : t -> int
(** As {!States.bytes}. *)

val bytes_to_grow : t -> by:int -> int
(** As {!States.bytes_to_grow}. *)

val bytes_to_rewrite : t -> words:int -> int
(** @raise Out_of_memory if there are too few addresses *)

val forget_waiting : t -> unit
(** As {!States.forget_waiting}, for the states that this worker has pushed. *)

val rewrite : t -> words:int -> (int array -> int array -> unit) -> t
(** As {!States.rewrite}, once the other workers are gone. *)

val iter : t -> (int -> unit) -> unit
(** [iter t f] calls [f] with the number of each state. *)

val close : t -> unit
(** As {!States.close}. *)

(** {1 Segments} *)

val filled : t -> int -> int
(** [filled t w] is how many states are in the segment of worker [w]. *)

val number : t -> int -> int -> int
(** [number t w p] is the number of the state at place [p] of the segment of worker [w]. *)
