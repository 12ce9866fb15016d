(** Writes the rules that run each example and compare its log with the golden one. *)
