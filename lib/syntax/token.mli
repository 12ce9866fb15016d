(** A token and its place. *)

type t = {
  token : Grammar.token;
  start : Lexing.position;
  stop : Lexing.position;
  newline : bool;  (** Whether a line ends between the token before and this one. *)
}

val at : t -> Location.t
(** [at t] is the place of [t]. *)

val text : source:string -> t -> string
(** [text ~source t] is [t] as the program spells it. *)

val line : t -> int
(** [line t] is the line where [t] starts. *)
