(** Assignments. Values are immutable, so to assign to an element or a member is to assign a new whole to the
    variable. *)

open Checks
open Core

val is_path : Ast.expression -> bool
(** Whether it may be assigned to: a variable, or an element or member of a target. *)

val assign : env -> Location.t -> Ast.expression -> expression -> expression
(** [assign env at target e] gives [target] the value of [e]. *)

val assign_variable : env -> Location.t -> string -> Location.t -> expression -> expression
(** [assign_variable env at name name_at e] is the same for the variable [name], which stands at [name_at]. *)

val set_global : env -> Location.t -> string -> expression -> expression
(** [set_global env at name e] gives the global [name] the value of [e], unchecked. *)

val check_given : env -> Ast.expression -> unit
(** Reports a variable that is changed, and that nothing gives a value before. *)

val update : env -> Location.t -> Ast.expression -> (expression -> expression) -> expression
(** [update env at target f] gives [target] the value of [f e], [e] being what it was. *)

val increment : env -> Location.t -> Ast.expression -> int -> bool -> expression
(** [increment env at target by prefix] adds [by], 1 or -1, to [target]. Its value is the new one with [prefix],
    otherwise the old one. *)

val check_assignable : Checks.env -> string -> Dolphin_syntax.Location.t -> unit
(** [check_assignable env x at] reports the name [x], which is not a local, if no program may assign it. *)
