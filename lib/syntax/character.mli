(** Characters in UTF-8. *)

val length : string -> int -> int
(** [length text i] is the number of bytes of the well-formed character at byte [i] of [text]; 0 if there is none, or if
    it is a zero byte. *)

val printable : string -> string
(** [printable text] is [text] with ["?"] for each character but line ends that {!Dolphin_utf8.Utf8.is_unfit}, and for
    each byte that is not part of a character: fit for terminals. *)
