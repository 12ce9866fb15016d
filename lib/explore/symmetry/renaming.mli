(** Vehicles by other names, in configurations. *)

open Dolphin_semantics

exception Too_large
(** A task or another value has too many parts to go through. *)

val value : (Core.vehicle -> Core.vehicle) -> Core.value -> Core.value
(** [value f x] is [x] with each vehicle [v] in it as [f v]. [f] is called in an order in which names play no part.
    @raise Too_large *)

val control : (Core.vehicle -> Core.vehicle) -> Configuration.control -> Configuration.control
(** Likewise.
    @raise Too_large *)

val tuples : Core.program -> (Core.vehicle -> Core.vehicle) -> in_no_order:(unit -> unit) -> Tuples.t -> Tuples.t
(** [tuples p f ~in_no_order n] is likewise for pairs of ordered keys; then [in_no_order ()] is called, and then [f] for
    other pairs, in an order in which names do play a part.
    @raise Too_large *)
