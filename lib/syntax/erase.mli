(** Programs without their locations: what two spellings of one program have in common. *)

val program : Ast.program -> Ast.program
(** [program p] is [p] with {!Location.none} everywhere. *)

val expression : Ast.expression -> Ast.expression
(** [expression e] is [e] with {!Location.none} everywhere. *)
