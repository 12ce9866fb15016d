(** Text of files that may be hostile, or in another encoding. *)

val without_mark : string -> string
(** [without_mark text] is [text] without the byte order mark of UTF-8. *)

val repaired : string -> string * int
(** [repaired text] is [text] with U+FFFD in place of each byte that is not part of a character in UTF-8, and how many
    these are. *)

val harmless : string -> string
(** [harmless text] is {!repaired} [text] with blanks in place of control characters, and none at its ends: fit for
    terminals. *)

val of_windows_1252 : string -> string
(** [of_windows_1252 text] is [text], which is in windows-1252, in UTF-8. *)

val of_iso_8859_15 : string -> string
(** [of_iso_8859_15 text] is [text], which is in ISO 8859-15, in UTF-8. *)
