(** Programs with other locations. *)

val program : (Location.t -> Location.t) -> Ast.program -> Ast.program
(** [program f p] is [p] with [f l] in the place of each location [l]. *)

val expression : (Location.t -> Location.t) -> Ast.expression -> Ast.expression
(** [expression f e] is the same for [e]. *)
