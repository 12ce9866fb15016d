(** Values known before a program runs: expressions that only compute, of literals, maps and variables with known
    values. *)

module Ast = Dolphin_syntax.Ast
module Diagnostic = Dolphin_syntax.Diagnostic

type t
(** The variables of a program that are known so, and how maps are read. *)

val function_names : Ast.program -> string list
(** The functions that it defines. *)

val of_program :
  chart:(string -> (Chart.t, string) result) -> place:Dolphin_geo.Position.t option -> Ast.program -> t
(** [of_program ~chart ~place ast] is the variables of [ast] that are assigned once, by a statement of the script
    outside of all braces, or declared as parameters, and have a known value. [place] is that of plans which have none
    of their own. *)

val chart : t -> Ast.expression -> Chart.t option
(** [chart constants e] is the chart that [e] surely is: a call of [map], or a variable that is one. *)

val value : t -> Ast.expression -> (Core.value, Diagnostic.t list) result
(** [value constants e] is the value of [e], or the reason why it is not known, with its place. *)

val fault : t -> Ast.expression -> Diagnostic.t option
(** [fault constants e] is the error that computing [e] ends with, if [e] is known to. *)
