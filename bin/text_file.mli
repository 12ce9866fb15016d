(** Files that people write. *)

val read : string -> (string, string) result
(** [read path] is the contents of the file, or one sentence on why it cannot be read. *)
