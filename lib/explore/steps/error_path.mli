(** How far the change that a step makes reaches. *)

val lifted : Component.step -> Dolphin_semantics.Residual.step * int ref
(** [lifted s] is [s] as a step of the whole task, as far as errors go: what goes on somewhere, or is gone from there,
    leaves all that stands around it as it is; an error climbs on, cuts off what stood beside, and passes through the
    contexts of nests. Once it is continued, the number is the level at which it stopped, if it did: 0 for what the step
    belongs to, 1 for the nest around that, ... *)
