(** The mission of the kill tests, and the vehicles that it is for. *)

val source : string
val fleet : string

val plans : string list
(** Each is to be started once. *)

val stopped : string
(** The one of them that has no end, and is to be stopped. *)
