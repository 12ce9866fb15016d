(** Files that runs are drawn in. *)

type t

val argument : t Cmdliner.Arg.conv
(** A name that ends in [.svg] or [.html]. *)

val path : t -> string
(** Where it is written. *)

val check : t -> (unit, string) result
(** Whether it seems that it can be written; the error says why not. Nothing is written yet. *)

val write : t -> Dolphin_trace.Summary.t -> (unit, string) result
(** The error says why it cannot be written. *)
