(** What this machine computes with. *)

val count : unit -> int
(** How many processors this process may use; 1 if the system does not say. *)
