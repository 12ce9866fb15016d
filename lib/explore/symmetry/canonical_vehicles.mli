(** Configurations of the script, and those in which a task begins, up to a permutation of vehicles within their orbits.
    The canonical form calls the vehicles of an orbit by its names in the order in which the configuration names them,
    and at a [pick] only as many of them report as can be wanted. docs/explorer.md proves that this is enough. *)

open Dolphin_semantics
open Dolphin_environment

type t

val create : Environment.options -> Core.program -> asked:Condition.t list -> World.t -> Symmetry.t -> t
(** [create o p ~asked w s] is for the orbits [s.vehicles], which are those of {!Symmetry.find}[ o p ~asked w], or finer
    ones. *)

val canonical : t -> Configuration.t -> Environment.t -> Configuration.t * Environment.t
(** [canonical r c e] is one of the configurations that differ from [c] in which vehicles of an orbit they name, and in
    what variables hold that nothing reads any more; mostly the same one for all of these. The conditions that are asked
    have the same answer in all.
    @raise Symmetry.Broken *)

val choices : t -> Environment.t -> Configuration.t -> (Transition.t * Environment.t) Seq.t
(** [choices r e c] is some of [Environment.choices]: of those that lead to one {!canonical} form, at least one.
    @raise Symmetry.Broken *)

val is_used : t -> bool
(** Whether some canonical form differed from the configuration, or some transition was left out. *)
