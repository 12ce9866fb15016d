(** A set of states, each a vector of a fixed number of words, that only grows. States are numbered from 0 in order of
    insertion, so the set is also the queue of a breadth-first search; each state knows its parent, the state that it
    was first reached from. All of it lives outside of OCaml's heap: uncompressed ({!Packed}), or in less memory and
    more time ({!Tree}), or on disk ({!On_disk}). *)

type t

exception Disk_failed of string
(** Why. Only of states on disk; any function may raise it then. *)

val create : compress:bool -> words:int -> t
(** [create ~compress ~words] is an empty set of vectors of [words] words. No word may be [-1]. *)

val words : t -> int
(** The number of words of each vector. *)

val count : t -> int
(** The number of states that have been added. *)

val push : t -> int array -> parent:int -> fresh:(int -> int -> unit) -> unit
(** [push t key ~parent ~fresh] adds the state in the first words of [key] unless it is a member: now, or at a later
    {!push} or {!flush}, in the order of pushes. [parent] is the state that it was found from, and never less than at
    the push before. When a new state is added, [fresh] is given its number and its first word. *)

val flush : t -> fresh:(int -> int -> unit) -> unit
(** [flush t ~fresh] adds all that has been pushed. *)

val find : t -> int array -> int
(** [find t key] is the number of state [key], or [-1]. On disk nothing may wait to be added. *)

val load : t -> int -> int array -> unit
(** [load t i key] puts the words of state [i] into [key]. *)

val parent : t -> int -> int
(** [parent t i] is the [parent] that state [i] was added with. *)

val bytes : t -> int
(** Memory in use outside of OCaml's heap. *)

val bytes_to_grow : t -> by:int -> int
(** [bytes_to_grow t ~by:n] is the most memory that adding [n] states may take at once. *)

val bytes_to_rewrite : t -> words:int -> int
(** [bytes_to_rewrite t ~words] is the most memory that {!rewrite} may take beside what is in use. *)

val forget_waiting : t -> unit
(** Drops the states that have been pushed and not been added: for lack of memory. *)

val rewrite : t -> words:int -> (int array -> int array -> unit) -> t
(** [rewrite t ~words f] is the states of [t] in a new encoding, with the same numbers and parents: [f old fresh] puts
    the new words of [old] into [fresh], which is all 0. [f] must be injective, and nothing may wait to be added. [t]
    is used up. *)

(** {1:disk On disk} *)

val is_on_disk : t -> bool
(** Whether {!spill} has put it on disk. *)

val spill : t -> directory:string -> tick:(unit -> unit) -> t
(** [spill t ~directory ~tick] is [t] on disk, in a file of [directory] without a name. [t] is not compressed,
    nothing waits to be added, and [t] is used up. From now on {!push} adds new states only when the memory that [t]
    had is full, or at {!flush}: that reads all states. [tick] is called meanwhile; it may raise something: then what
    has been pushed still waits. *)

(** {1:shared Shared} *)

val share : t -> workers:int -> t
(** [share t ~workers] is [t], with the same numbers, for [workers] processes ({!Shared_states}). [t] is not compressed,
    nothing waits to be added, and [t] is used up.
    @raise Out_of_memory if the system does not grant the addresses; [t] is as it was then *)

val is_shareable : t -> bool
(** Whether {!share} takes it: it is neither compressed nor on disk nor shared. *)

val shared : t -> Shared_states.t option
(** The shared set, if {!share} has made it. *)

val iter : t -> (int -> unit) -> unit
(** [iter t f] calls [f] with the number of each state. Only of shared states some numbers below the largest may be left
    out. *)

val close : t -> unit
(** [close t] gives back what is on disk or shared; [t] is of no use then. *)
