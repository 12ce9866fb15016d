(** Pictures are made of whatever journals tell. *)
