(** A warning of [(T | repeat U) during d], which does not end when T does. *)

val program : Dolphin_syntax.Ast.program -> Dolphin_syntax.Diagnostic.t list
