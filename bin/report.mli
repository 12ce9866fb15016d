(** What is told on standard error. *)

val complain : string -> unit
(** [complain sentence] tells what the trouble is, as ["dolphin: ..."]. *)

val diagnostics : source:string -> Dolphin_syntax.Diagnostic.t list -> unit
(** Each with the line of [source] that it points at, in the order of the text. *)

val count : int -> string -> string
(** [count 2 "error"] is ["2 errors"]. *)

val counts : Dolphin_syntax.Diagnostic.t list -> string
(** ["no errors"], ["1 error, 2 warnings"]. *)
