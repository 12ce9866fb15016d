(** Journals are written, read, judged and cut. *)
