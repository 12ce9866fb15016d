(** Queries of plans and vehicles before any vehicle moves: length, duration, consumption. *)
