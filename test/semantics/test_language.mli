(** Tests of single points of the semantics: answers, picks, the end of endless code, what tuple spaces forget. No value
    of its own. *)
