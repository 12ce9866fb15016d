(** A warning of [(T | repeat U) during d], which does not end when T does. *)

val program : Dolphin_syntax.Ast.program -> Dolphin_syntax.Diagnostic.t list
(** [program ast] is a warning for each such task of [ast], in the order of the text. *)
