(** The ends of lines. *)

val settle : Piece.t array -> unit
(** [settle pieces] makes [breaks] of [pieces] follow one rule: a body in braces is on one line as a whole, or has a
    line for each statement and for the closing brace; parentheses that open at the end of a line close at the start
    of one; a brace stands on the line of its owner. *)

val shorten : Piece.t array -> columns:int array -> width:int -> first:int -> stop:int -> bool
(** [shorten pieces ~columns ~width ~first ~stop] ends the line of pieces [first] up to, but without, [stop] at one
    place more or at several of one kind, and is whether there was one. [columns] is the column after each piece. *)
