(** Whether texts are UTF-8, which JSON asks for. *)

val is_valid : string -> bool

val repaired : string -> string
(** [repaired text] is [text] with U+FFFD in place of each byte that belongs to no character: [text] itself if it is
    valid. *)
