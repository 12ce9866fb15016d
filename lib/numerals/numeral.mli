(** Numbers as files and people write them. OCaml's own readers also take [0x29], [0b1], [1_000], [nan] and [inf]. *)

val number : string -> float option
(** [number text] is the number that [text] spells in decimal: a sign if any, digits with at most one point among,
    before or behind them, and a power of ten if any, as in [-8.7], [.5], [1e-3]. [None] for any other text, blanks
    included, and for numbers beyond the largest float. *)

val whole : string -> int option
(** [whole text] is the whole number that [text] spells in decimal: a sign if any, then digits. [None] for any other
    text, and for numbers that do not fit. *)

val whole_or_hexadecimal : string -> int option
(** {!whole}, or [0x] and hexadecimal digits of a number that is at least 0. *)
