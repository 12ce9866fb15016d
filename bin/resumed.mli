(** A run whose console died, as far as its journal tells of it. *)

type t = {
  path : string;  (** of the journal *)
  past : Dolphin_runtime.Resumption.t;
  log : Dolphin_display.Log.t;  (** as they were, like what follows *)
  board : Dolphin_display.Status.t;
  builder : Dolphin_trace.Summary.builder;
}

val read : changed:bool -> Program_file.t -> string -> (t, string) result
(** [read ~changed program path] goes through the journal [path]. With [changed] the program need not be the one that
    ran, if the journal is one of a run of it. The error tells people why there is nothing to go on with. *)

val fleet : t -> named:string option -> (Fleet_file.t, Fleet_file.trouble) result
(** The fleet that the run was on: the file that its header names, or [named], with the same text. *)
