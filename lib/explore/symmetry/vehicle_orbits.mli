(** Vehicles that a program, in a world, cannot tell from each other: peers. A partition of vehicles into classes. *)

open Dolphin_semantics
open Dolphin_environment

type t

val none : t
(** Each vehicle alone. *)

val find : Environment.options -> Core.program -> asked:Condition.t list -> World.t -> t
(** [find o p ~asked w] is the vehicles of [w] that have the same type and payload, stand at the same place and show the
    same battery as far as code of [p] looks at either, end the plans that [p] names in the same way, and are not named
    in [p]; nor in conditions that are [asked], whose code counts as code of [p]. It is {!none} if [p] makes something
    of names of vehicles ({!Name_flow}), or if vehicles may be late. It may still turn out that [p] tells some of them
    apart: see {!Canonical_vehicles}. *)

val is_none : t -> bool

val of_vehicle : t -> Core.vehicle -> Core.vehicle array
(** [of_vehicle p v] is the class of [v], in the order of the world, if there are others in it; otherwise [[||]]. *)

val split : (Core.vehicle -> 'a) -> t -> t
(** [split f p] is the classes of [p], each split up by [f], whose results are compared as data. *)
