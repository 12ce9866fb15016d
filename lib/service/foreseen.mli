(** Errors that a program surely comes to: its beginning is followed, by the transition function, for as long as only
    one thing can happen. *)

val found : own_fleet:bool -> Dolphin_semantics.Core.program -> Dolphin_scenario.Scenario.t ->
  Dolphin_syntax.Diagnostic.t list
(** [found ~own_fleet p s] is the error that ends [p] where its beginning leads, if there is one: at most one
    diagnostic. It is an error if nothing of the outside took part, so that every run ends there; otherwise it is a
    warning about runs in the world [s] in which no fault happens. [own_fleet] is whether [s] is meant for [p]: the lack
    of vehicles in any other fleet is not reported. Readings of sensors, and texts that [fail] gives, are never
    foreseen. *)
