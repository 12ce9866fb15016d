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
(** [canonical r c e] is one of the configurations that differ from [c] only in the choice of vehicles of an orbit, and
    in the values of dead variables; mostly the same one for all of these. The conditions that are asked have the same
    answer in all.
    @raise Symmetry.Broken *)

val choices : t -> Environment.t -> Configuration.t -> (Transition.t * Environment.t) Seq.t
(** [choices r e c] is some of [Environment.choices]: of those that lead to one {!canonical} form, at least one.
    @raise Symmetry.Broken *)

(** {1:recruits Recruits}

    Of the vehicles of an orbit that a configuration does not know, a [recruit] may have any: one is enough. *)

val known : t -> Configuration.t -> Environment.t -> Core.vehicle list
(** [known r c e] is the vehicles with others in their orbits that [c] or [e] mentions, except in the forgotten parts.
    @raise Symmetry.Broken *)

val known_in_task : t -> Residual.t -> Core.vehicle list
(** [known_in_task r t] is those that [t] names: a configuration that executes [t] knows these too.
    @raise Symmetry.Broken *)

val follows_recruit : t -> Vehicle_filter.t -> turn:int -> is_known:(Core.vehicle -> bool) -> Core.vehicle -> bool
(** [follows_recruit r q ~turn ~is_known v] is whether the [recruit] of [v] must be followed, for one that asks for [q]:
    whether [v] is known, alone in its orbit, or the first one of it that is not known, from the one numbered [turn] on,
    around.
    @raise Symmetry.Broken *)

(** {1:use Use} *)

val is_used : t -> bool
(** Whether some canonical form differed from the configuration, or some transition was left out. *)

val set_used : t -> unit
(** It was so in another process. *)
