(** Text in lines of at most [columns] columns, broken at spaces; longer words are broken too. *)

val lines : columns:int -> head:string -> string -> string list
(** [lines ~columns ~head text] is [text] after [head], with the overflow below its beginning. At least 16 columns
    are left to it, however long [head] is. *)

val hanging : columns:int -> string -> string list
(** [hanging ~columns text] is [text]; its second line and those that follow are indented. *)
