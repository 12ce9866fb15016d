(** String literals of TLA+, as TLC prints strings. *)

val unescape : string -> string option
(** [unescape s] is the string whose literal is [s], double quotes included. After a backslash may stand a backslash, a
    double quote, [n], [t], [r] or [f]. [None] if [s] is not the literal of one string. *)
