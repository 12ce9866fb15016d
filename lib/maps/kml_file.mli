(** KML: the places of a document, those in folders too. *)

val read : follow:(string -> bool) -> string -> Drawn.t list
(** [read ~follow text] is the contents of [text]. [follow href] is whether the target of a [NetworkLink] is read,
    too, by the caller. Raises {!Drawn.Wrong}. *)
