(** The reports of an adapter on a vehicle so far. *)

open Dolphin_platform_protocol
open Dolphin_semantics

type t

val add : Report.sight -> t option -> (t, string) result
(** [add s known] is the known state after [s], of a vehicle with the known state [known] before. The error names the
    missing members of a first report. *)

val link : t -> bool
(** Whether it has a link, by the last report. *)

val without_link : t -> t
(** [without_link s] is [s] after its link, or the adapter's, is gone. *)

val speed : t -> float option
(** Metres per second over the ground, if reported. *)

val battery : t -> float option
(** The charge, from 0 to 1, if reported. *)

val state : t -> World.vehicle_state option
(** The vehicle as programs see it; [None] before its position is known. *)

val describe : t -> World.vehicle_state
(** The same for displays; a position that is not known is 0, 0. *)

val is_placed : t -> bool
(** Whether its position is known. *)
