(** Names, and members of named values. *)

open Checks
open Core

val variable : env -> string -> Location.t -> expression
(** [variable env name at] is a local, a function of the program, or a global. *)

val elaborate : env -> string -> Location.t -> expression
(** [elaborate env name at] is a setting without values if it is one, otherwise {!variable}; names of the language
    that are not values are reported. *)

val member : env -> Ast.expression -> Ast.expression -> string Ast.located -> bool -> expression
(** [member env e subject name safe] is [e], which is [subject.name], or [subject?.name] if [safe]: a constant of the
    language such as [Speed.Units.RPM], or a property. *)
