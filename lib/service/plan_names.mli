(** The plans that a program names in its text. *)

val misspelt :
  Dolphin_semantics.Core.program -> Dolphin_scenario.Scenario.t -> Dolphin_syntax.Diagnostic.t list
(** [misspelt p s] warns of the plans that [p] names, as in [task('NAME')] and [imcPlan('NAME')], and [s] has no entry
    for, but one of nearly the same name. *)
