(** Loops whose rounds take no time. A run that gets into one stays at one instant until it is stopped as stuck. *)

open Dolphin_syntax
module Scenario = Dolphin_scenario.Scenario

val found :
  plans:(Ast.expression * Dolphin_plans.Inline_plan.t) list -> Ast.program -> Scenario.t -> Diagnostic.t list
(** [found ~plans ast s] warns of each [repeat T], [watch T onError { retry() }] and [while (true) { execute T }] of
    [ast] for which [T] surely takes no time in the world [s], and succeeds, or for [retry()] fails. [plans] are the
    values of those expressions that describe plans, as of {!Dolphin_semantics.Elaborate.known_plans}. A loop that code,
    a guard or a handler may end is left out. *)
