(** The contents of another program's map file, which a program names by [map]. *)

type t = {
  value : Core.value;  (** a map; [null] where a feature makes no place, line or area *)
  flawed : (string * string) list;  (** the names of these features, each with the reason *)
  notes : string list;  (** the parts left out of [value], and the repairs *)
}

val names : t -> string list
(** Of the features. *)
