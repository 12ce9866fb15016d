(** Positions from byte offsets, found in one pass over a text. *)

type t

val make : file:string -> string -> t
(** [make ~file source] is a cursor at the start of [source]. *)

val position : t -> int -> Lexing.position
(** [position cursor offset] is the position of byte [offset], which must not be before the one asked last.
    Its [pos_bol] is such that [pos_cnum - pos_bol] counts the characters, not the bytes, of the line before
    [offset]. *)
