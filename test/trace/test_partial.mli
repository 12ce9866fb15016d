(** Traces of only part of a run. *)
