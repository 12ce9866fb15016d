(** The values of a program's global variables, by their index in [Core.program.global_names]. *)

type t

val empty : t
(** No global has a value. *)

val find : int -> t -> Core.value option
(** The value of the global of that index. *)

val set : int -> Core.value -> t -> t
(** [set i x s] is [s] with [x] as the value of global [i]. *)

val compare : t -> t -> int
(** A total order. *)

val hash : t -> int
(** Equal stores have equal hashes. *)

val bindings : t -> (int * Core.value) list
(** Those that have a value, by index. *)
