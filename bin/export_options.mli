(** Options of the commands that write maps for other programs. *)

open Cmdliner

type t = { format : Dolphin_maps.Map_format.t option; path : string option }

val term : t Term.t
(** [--to FORMAT] and [-o FILE]. *)

val format : t -> (Dolphin_maps.Map_format.t, Dolphin_app.Error.t) result
(** The format that was named, or else that of the file's name. *)

val man : Manpage.block
(** The contents of the formats. *)
