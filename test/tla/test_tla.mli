(** Programs as models in TLA+: what is written, and what is refused. *)
