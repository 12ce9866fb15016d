(** OCaml source as lines, nested by indentation. *)

type t = Line of string | Nest of t list

val line : ('a, unit, string, t) format4 -> 'a
(** [line format ...] is one line. The empty one separates items. *)

val to_string : t list -> string
(** The text: each {!Nest} is indented by two blanks more than what surrounds it. *)
