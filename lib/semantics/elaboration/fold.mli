(** All expressions of a piece of a program, from the outside to the inside, left to right. *)

open Dolphin_syntax.Ast

val statement : ('a -> expression -> 'a) -> 'a -> statement -> 'a
(** [statement f acc s] is [acc] after [f] of each expression in [s], those in closures, functions and blocks of
    settings included. *)

val expression : ('a -> expression -> 'a) -> 'a -> expression -> 'a
(** [expression f acc e] is the same for [e], which comes first. *)
