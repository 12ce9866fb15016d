(** Configurations with their vehicles renamed. *)

open Dolphin_semantics

exception Too_large
(** A value has too many parts to go through: tasks may share parts, so that they are much larger than their memory. *)

val value : (Core.vehicle -> Core.vehicle) -> Core.value -> Core.value
(** [value f x] is [x] with each vehicle [v] in it as [f v]. [f] meets the vehicles in an order that does not depend on
    their names.
    @raise Too_large *)

val residual : (Core.vehicle -> Core.vehicle) -> Residual.t -> Residual.t
(** The same.
    @raise Too_large *)

val control : (Core.vehicle -> Core.vehicle) -> Configuration.control -> Configuration.control
(** The same.
    @raise Too_large *)

val tuples : Core.program -> (Core.vehicle -> Core.vehicle) -> unordered:(unit -> unit) -> Tuples.t -> Tuples.t
(** [tuples p f ~unordered n] does the same for the pairs of ordered keys; then it calls [unordered ()], and then [f]
    for the other pairs, in an order that depends on names.
    @raise Too_large *)
