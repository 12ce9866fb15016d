(** Limits of a process that computes for another one. *)

val memory : int -> unit
(** [memory n] limits the memory of this process to [n] megabytes of address space, or to the lower limit that it
    already has: beyond it, allocation raises [Out_of_memory], or the process is aborted.
    @raise Failure if the system refuses *)

val end_with_parent : unit -> unit
(** On Linux, this process is killed when its parent dies. Elsewhere, it has no effect. *)
