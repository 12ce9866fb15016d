(** Events that a command has overtaken: they are of tasks that the program has ended meanwhile. A vehicle that is
    stopped may be started again before such an event is read, and it would then be taken for one of the new task. So
    a holder of unread events drops these. *)

open Dolphin_semantics

val by_stop : Core.vehicle -> Platform.event -> bool
(** [by_stop v e] is whether [e] is the end of a task of [v]. *)

val by_cancel : Residual.timer -> Platform.event -> bool
(** [by_cancel timer e] is whether [e] is the expiry of [timer]. *)

val unless : (Platform.event -> bool) -> Platform.event Lwt.t -> bool
(** [unless overtaken told] is whether [told] is still to be read: it has not resolved to an event that is
    [overtaken]. *)

val left : (Platform.event -> bool) -> Platform.event Lwt.t option -> Platform.event Lwt.t option
(** [left overtaken upcoming] is [upcoming], the event that was asked for, if it is still to be read. *)
