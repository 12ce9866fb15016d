(** Expressions and statements of the surface language as expressions of the core. What is wrong with them is reported
    to the program's {!Scope}. *)

val statements : Checks.env -> Dolphin_syntax.Location.t -> Dolphin_syntax.Ast.statement list -> Core.expression
(** [statements env at body] is [body], which stands at [at], as one expression: its value is that of the last
    statement. *)
