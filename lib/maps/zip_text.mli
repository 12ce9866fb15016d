(** Files in a ZIP archive that may be hostile: nothing is written anywhere, and memory is bounded. *)

val files : most:int -> (string -> bool) -> string -> (string * string) list
(** [files ~most wanted archive] are the [wanted] files of [archive], by their names in it, with what they hold. Raises
    {!Drawn.Wrong} if it is no archive, or if they hold more than [most] bytes together. *)
