(** What a program says of itself to whoever starts it. *)

val lines : Program_file.t -> string list
(** The comment that it begins with, its parameters, and the inputs that it declares. *)
