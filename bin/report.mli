(** What the command tells on standard error. *)

val complain : string -> unit
(** [complain sentence] tells what the trouble is, as ["dolphin: ..."]. *)

val diagnostics : source:string -> Dolphin_syntax.Diagnostic.t list -> unit
(** Each with the line of [source] that it points at, in the order of the text. *)

val tell : Dolphin_app.Error.t -> unit
(** Tells why. *)

val error : Dolphin_app.Error.t -> Exit_status.t
(** [error e] tells [e], and is how the command ends for that reason. *)

val result : (Exit_status.t, Dolphin_app.Error.t) result -> Exit_status.t
(** [result r] is the status of [r], or {!error} of its error. *)

val counts : Dolphin_syntax.Diagnostic.t list -> string
(** ["no errors"], ["1 error, 2 warnings"]. *)
