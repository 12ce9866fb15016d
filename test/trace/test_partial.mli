(** Traces that tell only part of what happened. *)
