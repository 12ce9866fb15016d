(** Configurations up to the names of peers: vehicles that are alike are called in the order in which a configuration
    names them, and at a [pick] only as many of them report as could be wanted. docs/explorer.md says why that is
    enough. *)

open Dolphin_semantics
open Dolphin_environment

type t

exception Told_apart of Vehicle_orbits.t
(** It turned out that the program tells peers apart: these remain. Nothing that was found before counts. *)

val create : Environment.options -> Core.program -> asked:Condition.t list -> World.t -> Vehicle_orbits.t -> t
(** [create o p ~asked w peers] is for [peers] of what [Vehicle_orbits.find o p ~asked w] is. *)

val canonical : t -> Configuration.t -> Environment.t -> Configuration.t * Environment.t
(** [canonical r c e] is the same for configurations that differ in which of peers they name, and in what variables hold
    that nothing reads any more; and it is one of these. The conditions that are asked have the same answer in all.
    @raise Told_apart *)

val choices : t -> Environment.t -> Configuration.t -> (Transition.t * Environment.t) list
(** [choices r e c] is some of [Environment.choices]: of those that lead to one {!canonical} form, one at least.
    @raise Told_apart *)

val is_used : t -> bool
(** Whether something was left out, or is seen as something else. *)
