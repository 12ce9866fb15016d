(** Well-formedness beyond the grammar: programs that it accepts and that are refused nevertheless. Nothing here is
    recursive on the nesting of a program. *)

val limit : int
(** The deepest nesting of expressions and statements that is taken: 10,000. *)

val program : Ast.program -> Diagnostic.t list
(** [program p] is the faults of [p]: nesting deeper than {!limit} (only the first one is reported), and assignments
    to anything but a variable, an element or a member. *)

val expression : Ast.expression -> Diagnostic.t list
(** [expression e] is the faults of [e]. *)

(** A node of the syntax tree that {!children} goes through. *)
type node = Expression_node of Ast.expression | Statement_node of Ast.statement

val children : node -> node list
(** [children n] is the expressions and statements directly within [n], in no particular order. *)
