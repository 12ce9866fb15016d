(** Termination with rounds, compared with the definition of fairness. No value of its own. *)
