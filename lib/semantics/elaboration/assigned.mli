(** The names that a program gives a value to, by assignments, loops and parameters, whatever their scopes are. *)

open Dolphin_syntax.Ast

module Names : Set.S with type elt = string and type t = Set.Make(String).t
(** Sets of names: a program may have thousands. *)

val names : program -> Names.t
(** All of them. *)

val given : program -> Names.t
(** Those that get a value which does not depend on an earlier one: not by [x += 1] or [x++] alone. *)

val once : (expression -> bool) -> program -> Names.t
(** [once wanted ast] are those that get a value in one place only, by an assignment of an expression that is
    [wanted]. *)
