(** The names that a program gives a value to, by assignments, loops and parameters, whatever their scopes are. *)

open Dolphin_syntax.Ast

val names : program -> string list
(** All of them. *)

val given : program -> string list
(** Those that get a value which does not depend on an earlier one: not by [x += 1] or [x++] alone. *)

val once : (expression -> bool) -> program -> string list
(** [once wanted ast] are those that get a value in one place only, by an assignment of an expression that is
    [wanted]. *)
