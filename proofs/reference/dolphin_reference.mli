(** The command: it reads requests of the step protocol from its standard input. It has no interface. *)
