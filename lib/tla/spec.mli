(** The modules of the specification in [spec/]. *)

val modules : (string * string) list
(** Names of files, and texts. *)
