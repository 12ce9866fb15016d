(** The options of commands that speak to vehicles through adapters ([docs/platform.md]). *)

open Dolphin_app

val s_platforms : string
(** The section of manuals. *)

val checking : string list Cmdliner.Term.t
(** [--platform CMD] of commands that only ask adapters about plans. *)

val looking : string list Cmdliner.Term.t
(** [--platform CMD] of commands that only look at vehicles. *)

val adapters : string list Cmdliner.Term.t
(** [--platform CMD], which may be repeated. *)

val ask : string list -> Inline_plans.found list -> (Adapter_check.verdict list, Error.t) result
(** {!Adapter_check.ask}, which Ctrl-C interrupts. *)
