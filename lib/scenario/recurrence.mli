(** Assumptions on readings: [assume eventually { battery('a') > 0.8 }] in a fleet file. A choice that looks at the
    sensor again and again finds such a reading again and again: docs/explorer.md has the definition. *)

open Dolphin_syntax

val word : string
(** [assume]. *)

val read :
  vehicles:Entry.vehicle list -> Location.t -> Ast.argument list -> (Entry.recurrence list, Diagnostic.t list) result
(** [read ~vehicles at arguments] is the assumptions of an [assume] that stands at [at], in a fleet of [vehicles]: one,
    or with a parameter, as in [{ v -> battery(v) > 0.8 }], one for each of [vehicles] that may satisfy it or not. The
    condition is one comparison with one sensor, and some readings satisfy it while others do not. *)
