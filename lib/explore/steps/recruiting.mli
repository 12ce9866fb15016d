(** The vehicles recruited in a state, where some are interchangeable: docs/explorer.md, Symmetry of vehicles. *)

type t

val create : Canonical_vehicles.t -> Encoding.t -> Dolphin_checker.Numbering.t -> t
(** [create vehicles encoding numbering] is for recruits among the orbits of [vehicles]. *)

val follows : t -> Expansion.source -> Component.step -> bool
(** [follows t x step] is whether [step] of [x], if it is possible, must be followed: not if it recruits a vehicle in
    whose place another one of its orbit is recruited by such a step.
    @raise Symmetry.Broken *)
