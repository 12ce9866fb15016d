(** Tests of the laws of docs/semantics.md, as strong bisimilarity of explored state graphs. No value of its own. *)
