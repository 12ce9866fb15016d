(** Colours of a terminal, by their meaning. *)

type t

val bad : t
(** Red: trouble. *)

val doubtful : t
(** Yellow: possible trouble. *)

val strong : t
(** Bold: messages of the program. *)

val faint : t
(** Faint: what matters less. *)

val paint : colour:bool -> t -> string -> string
(** [paint ~colour t text] is [text] in [t] if [colour], else [text]. *)
