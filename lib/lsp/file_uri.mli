(** Files as editors name them: [file:///home/me/a%20mission.dol]. *)

val to_path : string -> string
(** [to_path uri] is the path that [uri] names; a text that is not a [file] URI is itself. *)

val of_path : string -> string
(** [of_path path] is the URI of the file [path], which is absolute. *)
