(** From the order to start a plan that takes no time to the word that it is done: over the platform protocol, and
    without it. *)
