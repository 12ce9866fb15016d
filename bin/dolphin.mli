(** The [dolphin] command. *)
