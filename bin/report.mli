(** The output of the command on standard error. *)

val complain : string -> unit
(** [complain sentence] prints the error, as ["dolphin: ..."]. *)

val of_arguments : Format.formatter
(** Standard error, for faults of the command line: what they quote is made harmless. *)

val diagnostics : source:string -> Dolphin_syntax.Diagnostic.t list -> unit
(** Each with the line of [source] that it points at, in the order of the text. *)

val tell : Dolphin_app.Error.t -> unit
(** Prints the reason. *)

val error : Dolphin_app.Error.t -> Exit_status.t
(** [error e] prints [e], and is the exit status for that reason. *)

val result : (Exit_status.t, Dolphin_app.Error.t) result -> Exit_status.t
(** [result r] is the status of [r], or {!error} of its error. *)

val counts : Dolphin_syntax.Diagnostic.t list -> string
(** ["no errors"], ["1 error, 2 warnings"]. *)
