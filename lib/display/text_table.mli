(** Tables of text. *)

val lines : ?columns:int -> string list -> string list list -> string list
(** [lines heads rows] is a line each for [heads] and [rows], in columns as wide as they need to be; no line ends with
    spaces. Cells are texts of any characters; line breaks in those of [rows] are shown as such.
    If a line has more than [columns] characters, each row goes on in further, indented lines. *)
