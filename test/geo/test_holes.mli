(** Holes that leave nothing of a polygon. *)
