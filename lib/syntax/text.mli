(** Whether a file is text at all. *)

val fault : file:string -> string -> Diagnostic.t option
(** [fault ~file source] is the first place where [source] is not UTF-8 text: a byte that belongs to no
    character, or a zero byte. *)
