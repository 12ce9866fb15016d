(** [dolphin explore]: is every run of a program sound? *)

val answers : string list Cmdliner.Term.t
(** [--answer TEXT], repeated: what may be answered. *)

val faults : int option option Cmdliner.Term.t
(** [--faults fail[=N]]. *)

val command : Exit_status.t Cmdliner.Cmd.t
