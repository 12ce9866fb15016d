(** Picking vehicles: PICK-BIND and PICK-ERR, for a script [m] that waits with shared part [s]. *)

val bindings : World.t -> Shared.t -> Machine.t -> Settings.pick -> Conclusion.t Seq.t Decision.t
(** [bindings w s m q] is the ways to meet [q] now, in pick order, computed on demand. A pick that takes all there are
    has none: it waits for its whole timeout. *)

val timed_out : World.t -> Shared.t -> Machine.t -> Settings.pick -> Conclusion.t option Decision.t
(** [timed_out w s m q] is the result of [q] at the end of the timeout; [None] if [q] can be met: then it must be. *)
