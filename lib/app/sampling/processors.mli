(** The processors of this machine. *)

val count : unit -> int
(** The number of processors that this process may use; 1 if the system does not report it. *)
