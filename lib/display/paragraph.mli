(** Text in lines of at most so many columns, broken at spaces; words that are longer are broken too. *)

val lines : columns:int -> head:string -> string -> string list
(** [lines ~columns ~head text] is [text] after [head], with what does not fit below its beginning. At least 16 columns
    are left to it, however long [head] is. *)

val hanging : columns:int -> string -> string list
(** [hanging ~columns text] is [text]; its second line and those that follow are indented. *)
