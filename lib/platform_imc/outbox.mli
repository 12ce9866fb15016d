(** The reports to the program: events that wait to be handed out, first in first out, and the last reports on
    vehicles. *)

open Dolphin_semantics
open Dolphin_runtime

type t

val empty : t
(** Nothing waits, nothing was reported. *)

val add : Platform.event -> t -> t
(** [add e b] is [b] with [e] at the end. News of a vehicle replaces news of it that still waits at the end: news do
    not pile up without a reader. *)

(** Reports at about once a second. *)
type periodic =
  | Everything  (** positions, batteries, readings *)
  | Moves  (** positions more than {!move} apart *)
  | Nothing

val vehicle : now:float -> urgent:bool -> periodic:periodic -> World.vehicle_state -> t -> t
(** [vehicle ~now ~urgent ~periodic state b] reports [state] if it differs from the last report on the vehicle: at
    once if link, readiness, type or payload differ, or if [urgent]; other changes as [periodic] allows. *)

val forget : Core.vehicle -> t -> t
(** [forget v b] is [b] without any report on [v]. *)

val told : Core.vehicle -> t -> World.vehicle_state option
(** The last report on the vehicle. *)

val take : t -> (Platform.event * t) option
(** The first event, and the others. *)

val is_empty : t -> bool
(** Whether no event waits. *)

val without_task : Core.vehicle -> t -> t
(** [without_task v b] is [b] without the end of a task of [v]. *)

val without_timer : Residual.timer -> t -> t
(** [without_timer t b] is [b] without the event that [t] expired. *)
