(** Pictures are made of any journals. *)
