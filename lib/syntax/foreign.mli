(** Words of neighbouring languages that Dolphin does not have. *)

val faults : Token.t array -> Diagnostic.t list
(** [faults tokens] lists each [try], [switch], [class], [import], [new] ... in arranged [tokens] that is used as in
    Groovy; a variable that happens to have such a name is not listed. *)

val is_word : string -> bool
(** [is_word x] is whether [x] is among those words. *)
