(** Journals that were tampered with are found out. *)
