(** What the vehicles of a program do right now: a line for each, for the foot of a terminal. *)

open Dolphin_semantics

type t

val start : t
(** Nothing has happened. *)

val transition : t -> time:float -> Transition.t -> t
(** [transition b ~time t] is [b] after [t] at [time] (seconds). *)

val news : t -> time:float -> World.vehicle_state -> t
(** [news b ~time state] is [b] after the news of a vehicle. *)

val lines : t -> string list
(** [lines b] is a line with the time, then one for each bound vehicle, in pick order: its task, for how long it has
    been running, its position and its battery. Of many vehicles the first {!most_lines} are shown. Empty while no
    vehicle is bound. *)

val most_lines : int
(** 12. *)
