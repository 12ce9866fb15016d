(** GPX: way points, routes, and the segments of tracks. *)

val read : string -> Drawn.t list
(** Raises {!Drawn.Wrong}. *)
