(** Certificates of random programs are accepted, and wrong ones refuted. It has no interface. *)
