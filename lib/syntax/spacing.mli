(** Blanks between tokens that stand on one line. *)

val before : Piece.t array -> int -> bool
(** [before pieces i] is whether a blank stands between piece [i] and the one before it, if no comment and no end of a
    line does. *)

val ends_head : Piece.t array -> int -> bool
(** [ends_head pieces i] is whether piece [i] is the parenthesis that closes the head of an [if], [while], [for] or
    [def]. *)

val is_prefix : Piece.t array -> int -> bool
(** [is_prefix pieces i] is whether piece [i] is a sign that stands before its one operand. *)
