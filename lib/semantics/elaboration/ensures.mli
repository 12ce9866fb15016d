(** [T ensure { a }]: the deeds of the end of a task. They cannot fail: [a] is posts and assignments to global
    variables, and their values are known when the task is made. *)

val elaborate :
  Checks.env -> Dolphin_syntax.Location.t -> in_branch:bool -> Dolphin_syntax.Ast.expression ->
  Dolphin_syntax.Ast.closure -> Core.expression
(** [elaborate env at ~in_branch t c] is [t ensure c]. Only if it is the whole task of a branch, [c] may have
    [giveBack()]. *)

val branch_operand : Checks.env -> Dolphin_syntax.Ast.expression -> Core.expression
(** [branch_operand env e] is [e] as the whole task of a branch. *)
