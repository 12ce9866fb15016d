(** Files in a ZIP archive that may be hostile: nothing is written anywhere, and memory is bounded. *)

val files : most:int -> (string -> bool) -> string -> (string * string) list
(** [files ~most wanted archive] are the [wanted] files of [archive], by their names in it, with their contents.
    Raises {!Drawn.Wrong} if it is not an archive, if they hold more than [most] bytes together, if one is cut
    short or does not have its checksum, or if two have one name. Resource forks of macOS are left out. *)
