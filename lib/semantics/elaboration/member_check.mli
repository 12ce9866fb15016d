(** Checks of members and calls of values whose kind is known before the program runs: an error for a member that no
    value of the kind has. *)

module Ast = Dolphin_syntax.Ast

val member :
  Checks.env -> called:bool -> ?arguments:Ast.argument list -> Ast.expression -> string Ast.located -> unit
(** [member env ~called ~arguments e x] reports [e.x], and if it is [called], [e.x(arguments)], when no value of [e]'s
    kind has such a member. *)

val callee : Checks.env -> Ast.expression -> Ast.argument list -> unit
(** [callee env e arguments] reports a call of [e] with [arguments] when [e] surely is not a function. *)

val prelude_call : Checks.env -> Dolphin_syntax.Prelude.entry -> Ast.argument list -> unit
(** [prelude_call env entry arguments] reports arguments of this function of the prelude that are of a wrong kind. *)
