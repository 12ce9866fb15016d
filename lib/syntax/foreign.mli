(** Words of neighbouring languages that Dolphin does not have. *)

val faults : Token.t array -> Diagnostic.t list
(** [faults tokens] tells of each [try], [switch], [class], [import], [new] ... in arranged [tokens] that is
    used as in Groovy; not of a variable that happens to have such a name. *)
