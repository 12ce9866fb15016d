(** What the log and the board show, and where they show it. *)
