(** Texts in the format of gzip (RFC 1952). *)

val gzip : string -> string
(** [gzip text] is [text] compressed: [gunzip] gives [text] back. *)
