(** Colours of a terminal, by what they mean. *)

type t

val bad : t
(** Red: trouble. *)

val doubtful : t
(** Yellow: what may become trouble. *)

val strong : t
(** Bold: what the program says. *)

val faint : t

val paint : colour:bool -> t -> string -> string
(** [paint ~colour t text] is [text] in [t] if [colour], else [text]. *)
