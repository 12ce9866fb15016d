(** Compares {!Reference} with {!Dolphin_semantics.Transition} along random runs of random programs. It has no
    interface. *)
