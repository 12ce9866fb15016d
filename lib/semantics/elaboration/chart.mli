(** What the file of another program, which a program names by [map], has on its map. *)

type t = {
  value : Core.value;  (** a map; [null] where a feature makes no place, line or area *)
  flawed : (string * string) list;  (** the names of these features, each with the reason *)
  notes : string list;  (** what is left out of [value], and what of it was repaired *)
}

val names : t -> string list
(** Of the features. *)
