(** The content of the log and the board, and its layout. *)
