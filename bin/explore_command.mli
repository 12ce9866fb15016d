(** [dolphin explore]: is every run of a program sound? *)

val answers : string list Cmdliner.Term.t
(** [--answer TEXT], repeated: what may be answered. *)

val faults : Dolphin_environment.Faults.t Cmdliner.Term.t
(** [--faults]. *)

val command : Exit_status.t Cmdliner.Cmd.t
