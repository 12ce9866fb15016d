(** Programs, from their files. *)

open Dolphin_syntax

type t = {
  path : string;
  source : string;
  program : Dolphin_semantics.Core.program;
  warnings : Diagnostic.t list;
}

(** Why there is no program. *)
type trouble =
  | Unreadable of string  (** one sentence *)
  | Wrong of { source : string; found : Diagnostic.t list }

val load : string -> (t, trouble) result
(** [load path] reads, parses and elaborates. *)

val parse : string -> (Ast.program, trouble) result
(** [parse path] only reads and parses. *)

val tell_fault : t -> Dolphin_semantics.Fault.t -> unit
(** Tells a fault of the program, with its place, on standard error. *)

val tell : trouble -> unit
(** On standard error. *)
