(** The values of a program's global variables, by their index in [Core.program.global_names]. *)

type t

val empty : t
val find : int -> t -> Core.value option
val set : int -> Core.value -> t -> t
val compare : t -> t -> int
val hash : t -> int

val bindings : t -> (int * Core.value) list
(** Those that have a value, by index. *)
