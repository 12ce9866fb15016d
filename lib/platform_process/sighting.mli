(** What an adapter has reported of a vehicle so far. *)

open Dolphin_platform_protocol
open Dolphin_semantics

type t

val add : Report.sight -> t option -> (t, string) result
(** [add s known] is what is known after [s], of a vehicle of which [known] was known. The error says what is missing of
    a first report. *)

val link : t -> bool
val without_link : t -> t

val speed : t -> float option
val battery : t -> float option

val state : t -> World.vehicle_state option
(** What programs see; [None] before its position is known. *)

val describe : t -> World.vehicle_state
(** The same for displays; a position that is not known is 0, 0. *)

val is_placed : t -> bool
