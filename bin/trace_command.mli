(** [dolphin trace]: journals of runs, judged, shown, drawn. *)

val command : Exit_status.t Cmdliner.Cmd.t

val show : bool -> string -> Exit_status.t
(** [show transitions path] prints the journal [path] as a page of text, or all its transitions. *)

val transitions : bool Cmdliner.Term.t
(** [--transitions]. *)
