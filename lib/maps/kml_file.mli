(** KML: the places of a document, those in folders too. *)

val read : string -> Drawn.t list
(** Raises {!Drawn.Wrong}. *)
