(** Programs without their locations: the common part of two spellings of one program. *)

val program : Ast.program -> Ast.program
(** [program p] is [p] with {!Location.none} everywhere. *)

val expression : Ast.expression -> Ast.expression
(** [expression e] is [e] with {!Location.none} everywhere. *)
