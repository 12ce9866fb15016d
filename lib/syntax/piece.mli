(** Tokens of a text with the text between them, for a new layout. *)

(** A comment between two tokens. *)
type comment = {
  text : string;
  fresh : bool;  (** Whether it begins a line. *)
  after_blank : bool;  (** Whether an empty line stands before it. *)
}

type t = {
  token : Grammar.token;  (** As {!Layout} hands it on. A string with holes is one [STRING]. *)
  text : string;  (** As the program spells it. *)
  comments : comment list;  (** Those between the piece before and this one. *)
  detached : bool;  (** Whether a line ends between the last of them, or else the piece before, and this one. *)
  after_blank : bool;  (** Whether an empty line does. *)
  set_apart : bool;  (** Whether anything at all stands between the piece before and this one. *)
  starts : bool;  (** Whether a statement begins here. *)
  ternary : bool;  (** Whether this is the colon of [c ? a : b]. *)
  enclosing : int;  (** The bracket around it: an index among the pieces, or -1. *)
  depth : int;  (** How many brackets are around it. *)
  partner : int;  (** Of a bracket, the other one; else -1. *)
  mutable breaks : bool;  (** Whether a line is to end before it, or before a comment that precedes it. *)
}

val of_tokens : source:string -> Token.t array -> t array
(** [of_tokens ~source tokens] is the pieces of [tokens], the arranged tokens of a program without faults, each with
    [breaks] as in [source]. The last is the end. *)
