(** Tests of the inference rules, at least one example each, and that docs/semantics.md, the code and these examples
    name the same rules. No value of its own. *)
