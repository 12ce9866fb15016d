(** Events that wait to be handed out, first in first out. *)

open Dolphin_semantics
open Dolphin_runtime

type t

val empty : t
(** Nothing waits. *)

val add : Platform.event -> t -> t
(** [add e b] is [b] with [e] at the end. News of a vehicle takes the place of news of it that still waits at the end:
    news do not pile up while nobody takes them. *)

val take : t -> (Platform.event * t) option
(** The first event, and the others. *)

val is_empty : t -> bool

val without_task : Core.vehicle -> t -> t
(** [without_task v b] is [b] without the end of a task of [v]. *)

val without_timer : Residual.timer -> t -> t
(** Without the event that this timer rang. *)
