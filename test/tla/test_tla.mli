(** Programs as models in TLA+: the written texts, and the refused programs. *)
