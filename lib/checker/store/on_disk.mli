(** A set of states as {!States} describes it, on disk: pushed states are kept in memory, in a {!Packed} set, until
    that is full, or a {!flush}. Then all states on disk are read once, in order; states not among them are new, and
    are appended. So what a level of the search finds takes memory, and the levels before take none but two bits a
    state for the parent. A state that is asked for ({!find}) is found by an index, on disk too, which is made when
    one is asked for the first time. *)

type t

exception Failed of string
(** The disk fails, or is full: why. *)

val of_packed : Packed.t -> directory:string -> tick:(unit -> unit) -> t
(** [of_packed s ~directory ~tick] is the states of [s], to which nothing waits to be added, in a file of [directory]
    that has no name. [s] is used up: its memory is for later pushed states, and no more is taken. [tick] is called now
    and then while the disk is read; its exceptions pass through, and no pushed state is lost then.
    @raise Failed *)

val words : t -> int
(** As {!States.words}. *)

val count : t -> int
(** As {!States.count}: on disk, without states that wait in memory. *)

val push : t -> int array -> parent:int -> fresh:(int -> int -> unit) -> unit
(** @raise Failed as the others do *)

val flush : t -> fresh:(int -> int -> unit) -> unit
(** As {!States.flush}: reads all states on disk. *)

val find : t -> int array -> int
(** As {!States.find}. *)

val load : t -> int -> int array -> unit
(** As {!States.load}. *)

val parent : t -> int -> int
(** As {!States.parent}. *)

val bytes : t -> int
(** Of memory. *)

val forget_waiting : t -> unit
(** As {!States.forget_waiting}. *)

val rewrite : t -> words:int -> (int array -> int array -> unit) -> t
(** As {!States.rewrite}. *)

val close : t -> unit
(** [close t] gives back what is on disk; [t] is of no use then. *)
