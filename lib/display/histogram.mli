(** Bars on a terminal. *)

val lines : columns:int -> (string * int) list -> string list
(** [lines ~columns bars] is a line for each bar: its name, its number, and as much of what is left of [columns], or of
    100 characters if that is less, as its number is of the greatest one. A number that is not 0 has one character at
    least, and the greatest has ten, whatever [columns] is. *)
