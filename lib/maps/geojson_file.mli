(** GeoJSON, RFC 7946. *)

val read : string -> Drawn.t list
(** The geometries of all features. A name is the feature's property [name], [Name], [NAME], [title] or [label], or its
    identifier. Raises {!Drawn.Wrong}. *)
