(** Runs whose console died, gone on with. *)
