(** [dolphin explore]: is every run of a program sound? *)

val answers : string list Cmdliner.Term.t
(** [--answer TEXT], repeated: the possible answers. *)

val faults : Dolphin_environment.Faults.t Cmdliner.Term.t
(** [--faults]. *)

val run_file : string Cmdliner.Arg.conv
(** The name of a file that a run is written into: no picture. *)

(** {1 Bounds} *)

val max_states : int option Cmdliner.Term.t
val max_depth : int option Cmdliner.Term.t

val max_memory : int option Cmdliner.Term.t
(** In bytes. *)

val timeout : float option Cmdliner.Term.t

val command : Exit_status.t Cmdliner.Cmd.t
