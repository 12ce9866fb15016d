(** Places of a text as editors count them: lines from 0, and in a line code units of UTF-16 from 0. *)

type t = { line : int; character : int }

val of_offset : string -> int -> t
(** [of_offset text n] is the place of byte [n] of [text]. *)

val to_offset : string -> t -> int
(** [to_offset text p] is the byte of [text] at [p]; beyond a line's end, that end; beyond the text, its end. *)
