(** String literals of TLA+, as TLC prints strings. *)

val unescape : string -> string option
(** [unescape s] is the string whose literal is [s], with its double quotes: with backslash, double quote, [n], [t], [r]
    and [f] after a backslash for these characters. [None] if [s] is not the literal of one string. *)
