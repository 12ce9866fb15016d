(** An executable. *)
