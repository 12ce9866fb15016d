(** The expressions that an expression is made of, one level down. Code, tasks and builders have none here: their parts
    are evaluated elsewhere, or later. *)

val map : (Ast.expression -> Ast.expression) -> Ast.expression -> Ast.expression
(** [map f e] is [e] with [f o] for each of its operands [o], in the same place of the text. *)

val map_argument : (Ast.expression -> Ast.expression) -> Ast.argument -> Ast.argument
(** The same for an argument of a call. *)
