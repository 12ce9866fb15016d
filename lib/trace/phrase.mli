(** Phrases that people read. *)

val time : float -> string
(** [time seconds] is the time of a stop-watch, in whole seconds: ["0:07"], ["9:00"], ["1:02:03"]. *)

val count : int -> string -> string
(** [count 2 "line"] is ["2 lines"], [count 1 "line"] is ["1 line"]. *)
