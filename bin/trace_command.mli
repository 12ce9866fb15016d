(** [dolphin trace]: journals of runs, judged, shown, drawn. *)

val command : Exit_status.t Cmdliner.Cmd.t
