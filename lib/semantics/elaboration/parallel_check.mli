(** Finds, before a program runs, tasks that need one vehicle twice at the same time, where the text alone shows it:
    [a[v] | b[v]] with [v] picked once as a single vehicle. {!Allocation} finds the others when [execute] starts. *)

val program : Dolphin_syntax.Ast.program -> Dolphin_syntax.Diagnostic.t list
(** An error for each such pair of tasks. *)
