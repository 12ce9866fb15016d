(** Programs, from their files. *)

open Dolphin_syntax

type t = {
  path : string;
  source : string;  (** the text, and behind it that of the files that it includes *)
  program : Dolphin_semantics.Core.program;
  warnings : Diagnostic.t list;
}

val load : string -> (t, Error.t) result
(** [load path] is the program in the file [path], parsed and elaborated, with what it includes
    ({!Dolphin_syntax.Include}). *)

val parse : string -> (Ast.program, Error.t) result
(** [parse path] is the syntax tree of the program in the file [path], which need not elaborate. *)

val header : t -> Dolphin_trace.Header.source
(** The program as journals name it: by its path and the digest of its text. *)

val diagnostic : t -> Dolphin_semantics.Fault.t -> Diagnostic.t
(** [diagnostic p fault] is the fault of a run of [p], with its place in the text if it has one. *)

val unsettled : t -> Dolphin_semantics.Fault.t -> Error.t
(** [unsettled p fault] is {!Error.Unsettled}, with [diagnostic p fault]. *)
