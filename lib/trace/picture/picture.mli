(** A run as a picture: who ran what when, where the vehicles went, what became of their batteries. *)

val svg : Summary.t -> string
(** A document of its own, without references to anything outside. It follows the viewer's choice of light or dark, and
    prints dark on white. *)

val html : Summary.t -> string
(** The same in a page, with the tasks as a table below. *)
