(** The orbits of vehicles under the permutations that no step of a program, in a world, depends on. A partition of the
    vehicles; the group is the product of the symmetric groups on its classes. *)

open Dolphin_semantics
open Dolphin_environment

type t

val none : t
(** Each vehicle alone. *)

val find :
  Environment.options -> Core.program -> asked:Condition.t list -> ?named:(Core.vehicle -> bool) -> World.t -> t
(** [find o p ~asked ~named w] puts two vehicles of [w] into one orbit if they have the same type and payload, the same
    place, sensors, speed and drain as far as code of [p] reads these, and the same endings of the plans that [p] names,
    if both may be late or neither, and if no text in [p] is the name of either, and neither is [named] (by default none
    is). Conditions that are [asked] count as code of [p]. It is {!none} if a step may depend on a vehicle's name
    ({!Name_flow}). States may show later that a symmetry is broken after all ({!Canonical_vehicles}). *)

val is_none : t -> bool
(** Whether no two vehicles are in one orbit. *)

val of_vehicle : t -> Core.vehicle -> Core.vehicle array
(** [of_vehicle p v] is the orbit of [v], in the order of the world, if there are others in it; otherwise [[||]]. *)

val split : (Core.vehicle -> 'a) -> t -> t
(** [split f p] is the orbits of [p], each split up by [f], whose results are compared as data. *)

(** {1:naming Naming} *)

type naming
(** A permutation that is being made: it names the vehicles of each orbit in the order in which they are met. *)

val naming : t -> naming
(** [naming t] is a permutation of which nothing is decided. *)

val name : naming -> Core.vehicle -> Core.vehicle
(** [name n v] is the name that [v] has, or else the first of its orbit that no vehicle has yet, which is now its. *)

val name_of : naming -> Core.vehicle -> Core.vehicle option
(** [name_of n v] is the name that [v] has, if it has one. *)

val is_identity : naming -> bool
(** Whether each vehicle that has a name has its own. *)
