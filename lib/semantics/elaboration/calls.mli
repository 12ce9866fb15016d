(** Calls: of procedures of the language, of functions, closures and methods. *)

open Checks
open Core

val call : env -> Location.t -> Ast.expression -> Ast.argument list -> expression
(** [call env at callee arguments] calls [callee], or is the setting of that name. *)

val on_interrupt : env -> Location.t -> Ast.argument list -> expression
(** The declaration [onInterrupt T]. *)

val input : env -> Location.t -> Ast.argument list -> expression
(** [input env at arguments] declares the keys of the pairs that the outside may post. *)

val assertion : env -> Location.t -> Ast.argument list -> expression
(** [assertion env at arguments] is [assert] as a statement, checked at once; as an operand it is a task. *)
