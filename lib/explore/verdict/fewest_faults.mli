(** {!Search}, with runs that have as few faults as can be: a violation that needs no fault is shown without one. *)

open Dolphin_semantics
open Dolphin_environment

val run : ?start:Configuration.t * Environment.t -> Search.options -> Core.program -> World.t -> Search.outcome
(** [run ~start o p w] is {!Search.run}, but each violation is shown by a run with the fewest faults, and of these
    by a shortest one, as far as further searches find them: one without faults, within the limits of [o]; then, where
    the first run has [n] faults, those with at most 1 to [n - 1] faults, reduced by the symmetry of vehicles alone.
    They have [o.search_again] states each, and half as many after each that is cut short. Without possible faults it is
    {!Search.run}. Faults are not counted in runs that never end, and runs that violate a formula, of programs in which
    vehicles may stay away from a [recruit]: no step shows these. *)
