(** Pieces of code that stand by themselves: a program, its functions, expressions. *)

open Core
module Ast = Dolphin_syntax.Ast

val shell : Scope.program -> Dolphin_syntax.Location.t -> string -> int -> lambda
(** [shell p at label n] is the code [label] at [at], with [n] parameters, that is still empty. *)

val fill :
  Checks.env -> lambda -> Scope.purpose -> string Ast.located list -> Dolphin_syntax.Location.t ->
  Ast.statement list -> unit
(** [fill env lambda purpose parameters at body] makes [body] the code of [lambda]. *)
