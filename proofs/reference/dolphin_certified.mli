(** The command: it checks the certificate that it is given. It has no interface. *)
