(** Tests of single points of the semantics: answers, picks, the end of endless code, the orders that tuple spaces
    forget. No value of its own. *)
