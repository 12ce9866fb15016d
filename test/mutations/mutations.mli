(** Throws mutated datagrams, from recordings, at the codec and at a console that has a plan running, and ends with
    status 1 if one of them raises an exception, changes the console's state though it is invalid, or if memory
    grows. *)
