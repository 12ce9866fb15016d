(** [fence inside harbour, margin: 20.m]: the declarations of this word. *)

module Ast = Dolphin_syntax.Ast
module Diagnostic = Dolphin_syntax.Diagnostic

val word : string
(** ["fence"]. *)

val read :
  Constants.t ->
  Dolphin_syntax.Location.t ->
  Ast.argument list ->
  (Dolphin_plans.Fences.fence list, Diagnostic.t list) result
(** [read constants at arguments] is the fences declared by [fence] with these [arguments], at [at]: one for each
    area of a map or a list, else one; or their fault, with its place. *)

val is_declaration : Ast.statement -> bool
(** Whether a statement at the top of a program declares a fence. *)

val of_program : Constants.t Lazy.t -> Ast.program -> (Dolphin_plans.Fences.fence list, Diagnostic.t list) result
(** The fences that stand in the script, outside of all braces; or what is wrong with any. *)

val is_own : Ast.program -> bool
(** Whether the program has a variable or a function of this name: then it declares no fences. *)

val plans : Constants.t -> Ast.program -> (Ast.expression * Dolphin_plans.Inline_plan.t) list
(** [plans constants ast] is the plans and missions of the program that are known before it runs, each with the place
    of its description. *)

val broken : Dolphin_plans.Fences.t -> (Ast.expression * Dolphin_plans.Inline_plan.t) list -> Diagnostic.t list
(** [broken fences plans] is an error for each of [plans] that breaks a fence from any place of its vehicle, at the
    maneuver if that is known. *)
