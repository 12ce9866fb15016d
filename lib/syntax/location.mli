(** A stretch of source text. *)

type t = { start : Lexing.position; stop : Lexing.position }
(** From [start] up to, but without, [stop]. [pos_cnum] counts bytes of UTF-8 text; [pos_bol] is such that
    [pos_cnum - pos_bol] counts the characters before it on its line (see {!Cursor}). *)

val none : t
(** The location of a node without source text. *)

val make : Lexing.position * Lexing.position -> t
(** From the start to the stop. *)

val file : t -> string
(** The file's name. *)

val line : t -> int
(** The line of the start, from 1. *)

val column : t -> int
(** The column of the start in characters, as an editor shows it, from 1. *)

val pp : Format.formatter -> t -> unit
(** ["FILE:LINE:COLUMN"]. *)
