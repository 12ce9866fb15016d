(** XML that may be hostile: entities are not expanded, nothing else is read, and depth is bounded. *)

type t = {
  tag : string;  (** without its prefix *)
  attributes : (string * string) list;
  inside : t list;
  text : string;  (** its direct text, trimmed *)
  place : string;  (** the line *)
}

val read : string -> t
(** The root. Raises {!Drawn.Wrong}. *)

val most_deep : int
(** 100. *)

val child : string -> t -> t option
(** The first of that tag. *)

val children : string -> t -> t list
(** [children tag x] is the children of [x] with this tag, in order. *)

val text_of : string -> t -> string
(** That of the first child of that tag, [""] without one. *)

val number : t -> string -> float
(** [number x text] is the number that [text] spells, or wrong at the place of [x]. *)
