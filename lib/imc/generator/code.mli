(** OCaml source as lines, nested by indentation. *)

type t = Line of string | Nest of t list

val line : ('a, unit, string, t) format4 -> 'a
(** [line format ...] is one line. *)

val under : string -> t list -> t list
(** [under head body] is the line [head] with [body] indented below it. *)

val enclosed : string -> t list -> string -> t list
(** [enclosed head body foot] is [under head body], then the line [foot]. *)

val paragraphs : t list list -> t list
(** The parts that are not empty, with an empty line between each two. *)

val to_string : t list -> string
(** The text: each {!Nest} is indented by two blanks more than what surrounds it. *)
