(** The plans that a program names in its text. *)

val of_program : Dolphin_semantics.Core.program -> (string * Dolphin_syntax.Location.t) list
(** [of_program p] is every [task('NAME')] and [imcPlan('NAME')] of [p] with a literal name, in the order of the
    text. *)

val misspelt :
  Dolphin_semantics.Core.program -> Dolphin_scenario.Scenario.t -> Dolphin_syntax.Diagnostic.t list
(** [misspelt p s] warns of the plans that [p] names and [s] has no entry for, but one of nearly the same name. *)
