(** The names that a program gives a value to, by assignments, loops and parameters, whatever their scopes are. *)

open Dolphin_syntax.Ast

val names : program -> string list
(** All of them. *)

val once : (expression -> bool) -> program -> string list
(** [once wanted ast] are those that get a value in one place only, by an assignment of an expression that is
    [wanted]. *)
