(** Tests that the views of residuals and tasks see the same parts. No value of its own. *)
