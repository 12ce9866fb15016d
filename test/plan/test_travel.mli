(** What is asked of plans and vehicles before anybody moves: how far, how long, how much of a battery. *)
