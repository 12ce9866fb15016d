(** Phrases that several use cases need. *)

val count : int -> string -> string
(** [count 2 "error"] is ["2 errors"], [count 1 "error"] is ["1 error"]. *)
