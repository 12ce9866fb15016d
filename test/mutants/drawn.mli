(** Draws mistakes: a folder by its weight, a kind, then a place, each with the same chance as its like. *)

type t = { file : string; mutation : Mutation.t }

val draw : seed:int -> count:int -> is_wanted:(string -> bool) -> t list
(** [draw ~seed ~count ~is_wanted] is [count] different mistakes in the files below the working directory that
    {!Judges.all} covers and that [is_wanted], or as many as there are. *)

val at : string -> t list
(** [at "lib/time/zone.ml:17"] is every mutation of that line, [at "lib/time/zone.ml"] of that file. *)
