(** How much memory this process has, and can still have. Linux tells; elsewhere nothing is known. *)

val taken : unit -> int option
(** Bytes that are in the machine's memory: code, libraries and all. [None] if that cannot be read. *)

val left : unit -> int option
(** Bytes: the least of what the machine has available without swapping, what the control groups that the process is in
    (version 1 or 2) leave to it, and what its limit of address space does ([ulimit -v]). [None] if nothing can be
    read. *)
