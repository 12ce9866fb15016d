(** How much memory this process has, and can still have. Only Linux reports it. *)

val taken : unit -> int option
(** Bytes that are in the machine's memory: code, libraries and all. [None] if that cannot be read. *)

val left : unit -> int option
(** Bytes: the least of the memory that the machine has available without swapping, the rest that the control groups
    of the process (version 1 or 2) leave to it, and the rest of its limit of address space ([ulimit -v]). [None] if
    nothing can be read. *)
