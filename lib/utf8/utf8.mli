(** Text in UTF-8 that may be hostile: which bytes of it are characters. Source: the Unicode standard, table 3-7. *)

val length : string -> int -> int
(** [length text i] is the number of bytes of the well-formed character at byte [i] of [text], from 1 to 4; 0 if there
    is none. *)

val is_control : string -> int -> bool
(** [is_control text i] is whether the character at byte [i] of [text] is a control character: U+0000 to U+001F, U+007F
    to U+009F. *)

val is_unfit : string -> int -> bool
(** [is_unfit text i] is whether the character at byte [i] of [text] is unfit for a line of text that people read:
    {!is_control}; U+2028 and U+2029, which end lines; U+202A to U+202E and U+2066 to U+2069, which change the direction
    of what follows, so that it reads as another text; U+FFFE and U+FFFF, which XML does not have. *)

(** {1:texts Texts} *)

val is_valid : string -> bool
(** Whether each byte belongs to a character. *)

val replacement : string
(** U+FFFD. *)

val repaired : string -> string
(** [repaired text] is [text] with U+FFFD in place of each byte that belongs to no character: [text] itself if it is
    valid. *)

val strays : string -> int
(** [strays text] is the number of bytes of [text] that belong to no character. *)

val line : string -> string
(** [line text] is {!repaired} [text] with U+FFFD in place of each character that {!is_unfit}, line ends among them: fit
    for one line on a terminal. [text] itself if nothing is to be replaced. *)
