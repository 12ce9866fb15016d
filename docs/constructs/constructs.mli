(** Writes what follows from the table of constructs ([lib/syntax/construct.ml]): a file, or the one that is given with
    the lists in it brought up to date. *)
