(** Going through lists with functions that may fail. *)
