(** Whether a file is text at all. *)

val fault : file:string -> string -> Diagnostic.t option
(** [fault ~file source] is the first place where [source] is not UTF-8 text: a byte that belongs to no
    character, or a zero byte. *)

val character : string -> int -> int
(** [character source i] is the number of bytes of the well-formed UTF-8 character at [i], or 0 without one; 0 for a
    zero byte, too. *)
