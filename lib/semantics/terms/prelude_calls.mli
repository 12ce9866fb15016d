(** The calls of a program that lead to a place in the prelude. *)

type t = {
  name : string;  (** the function of the prelude that has the place *)
  calls : Dolphin_syntax.Location.t list;
  (** the places of the program that call this function, or another one of the prelude that calls it; in the order
      of the text, without repetition *)
}

val to_site : Core.program -> Core.site -> t option
(** [to_site program site] is [None] unless [site] is a place in the prelude. *)
