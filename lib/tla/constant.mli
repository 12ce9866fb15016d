(** Parts of a program that compute the same value whenever they run: positions, areas, inline plans. TLA+ has no
    trigonometry, so they are computed once, here. *)

open Dolphin_semantics

val is_closed : Core.expression -> bool
(** [is_closed e] is whether [e] depends on no variable from outside of it and does nothing that others see. *)

val value : Core.program -> World.t -> Core.expression -> (Core.value, Fault.t) result
(** [value p w e] is the value of [e], which is closed. *)
