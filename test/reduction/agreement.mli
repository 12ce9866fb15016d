(** Whether a reduced search finds what the plain one finds. *)

open Dolphin_semantics
open Dolphin_environment
open Dolphin_explore

type t = {
  whole : int;  (** states *)
  reduced : int;  (** by the last reduction *)
  broken : Property.t list;
}

val check :
  ?limit:int ->
  ?reductions:Reduction.t list ->
  Environment.options ->
  Core.program ->
  World.t ->
  (t option, string) result
(** [check ~reductions o p w] is an error unless all searches, plain and with each of the reductions (at first
    [Partial_order], [Symmetry], [All]), find the same properties broken, the same code unreached, and each run that a
    reduced one shows is one of the semantics that ends as it should; and unless with [Partial_order] executing tasks
    come to the same as without: to the same configurations of the script, the same deadlocks, the same halts and
    failures. [None] if the program has more than [limit] states. *)

val check_peers :
  ?limit:int ->
  ?invariants:Condition.t list ->
  Environment.options ->
  Core.program ->
  World.t ->
  ((t * bool) option, string) result
(** [check_peers o p w] is the same with [All] and [Symmetry], and is an error unless the script comes to the same
    configurations as without, up to the classes of [Vehicle_orbits.find], and each of the invariants holds as
    without. The truth value is whether some of that was exchanged. *)
