(** An abstract type. *)

type t

val make : int -> t
