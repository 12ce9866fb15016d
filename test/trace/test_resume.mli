(** Runs whose console died, resumed. *)
