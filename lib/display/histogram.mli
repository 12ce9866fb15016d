(** Bars on a terminal. *)

val lines : columns:int -> (string * int) list -> string list
(** [lines ~columns bars] is a line for each bar: its name, its number, and a bar in the rest of [columns], or of 100
    characters if that is less, in proportion to the greatest number. A number that is not 0 has one character at
    least, and the greatest has ten, whatever [columns] is. *)
