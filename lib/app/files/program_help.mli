(** The description of a program for its user. *)

val lines : Program_file.t -> string list
(** The comment that it begins with, its parameters, and the inputs that it declares. *)
