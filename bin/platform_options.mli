(** The options of commands that speak to vehicles through adapters ([docs/platform.md]). *)

val s_platforms : string
(** The section of manuals. *)

val adapters : string list Cmdliner.Term.t
(** [--platform CMD], which may be repeated. *)
