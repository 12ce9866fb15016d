(** Blocks of settings: [pick], [pos], inline plans, [allOf] and [oneOf]. The settings gather in a local. *)

open Checks
open Core

val build : env -> Location.t -> Ast.builder -> Ast.statement list -> expression
(** [build env at builder body] is the value that [builder] makes of the settings in [body]. *)

val pick_if_any : env -> Location.t -> Ast.statement list -> expression
(** [pick_if_any env at body] is [build env at Pick body], but gives null where there are too few vehicles. *)

val recruit : env -> Location.t -> Ast.statement list -> Ast.closure -> expression
(** [recruit env at body c] is [recruit { body } then { c }]. *)

val add : env -> Location.t -> int -> string -> Ast.argument list -> expression
(** [add env at slot name arguments] adds setting [name] to those in [slot]. *)

val setting : env -> Location.t -> string Ast.located -> Ast.expression -> expression
(** [setting env at name e] is the statement [name: e]. *)

val when_then : env -> Location.t -> Ast.closure -> Ast.expression -> expression
(** [when_then env at guard t] adds a branch to the [allOf] or [oneOf] around. *)
