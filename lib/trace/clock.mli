(** Times, as people read them. *)

val text : float -> string
(** [text seconds] is the time of a stop-watch, in whole seconds: ["0:07"], ["9:00"], ["1:02:03"]. *)
