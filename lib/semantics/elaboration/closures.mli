(** Code between braces in the core: a lambda, and its captured variables. *)

open Checks
open Core

val make_lambda :
  env ->
  Location.t ->
  Scope.purpose ->
  string ->
  parameters:string Ast.located list ->
  implicit:bool ->
  (env -> Location.t -> expression) ->
  lambda * int list
(** [make_lambda env at purpose label ~parameters ~implicit body] is a lambda whose code [body] makes, in a piece of its
    own, and the slots around it that it captures. [implicit] is whether it may be called without its argument. *)

val closure : env -> Location.t -> Scope.purpose -> string -> Ast.closure -> expression
(** [closure env at purpose label c] makes the closure [c]; one that names no parameters has [it]. *)

val handler : env -> Location.t -> Ast.closure -> expression
(** [handler env at c] is the code [c] of an [onError]: its parameter is the error's message, and further ones, by
    {!Scope.field}, the vehicle and the task that failed, or null. *)

val task_code : env -> Location.t -> string -> Ast.closure -> expression
(** [task_code env at construct c] is {!closure} for code of a task, which takes no parameters. *)

val told_code : env -> Location.t -> string -> Ast.closure -> expression
(** [told_code env at construct c] is {!task_code}, labelled with the text of [c], for messages. *)

val told : Ast.closure -> expression -> expression
(** [told c e] is [e], the closure made of [c], labelled by the text of [c]. *)

(** {1 confirm} *)

val confirmation : env -> Ast.expression -> Ast.argument list option
(** [confirmation env e] is the arguments of [confirm], if [e] is a call of it. *)

val prompt_of : env -> Location.t -> Ast.argument list -> Ast.expression option
(** [prompt_of env at arguments] is the prompt among the arguments of [confirm]; [None] if that was reported. *)

val confirm_task : env -> Location.t -> Ast.argument list -> expression
(** [confirm_task env at arguments] is the [confirm] of these arguments as a task. *)

(** {1 Operands} *)

val branch_operand : env -> Ast.expression -> expression
(** As {!task_operand}, for the task of a branch: its code may have parameters, for the pairs that the guard took. *)

val task_operand : env -> Ast.expression -> expression
(** [task_operand env e] is [e] in the place of a task: code there makes the task, and may only compute; [confirm] is a
    task. *)
