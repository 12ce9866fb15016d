(** One vehicle as a body: its place and its charge, at any time. Neither is computed before it is asked for: between
    two commands both are functions of time. Times are seconds since the start. *)

open Dolphin_scenario

type t

val make : Scenario.vehicle -> t
(** At its place and at rest, at time 0. *)

val scenario : t -> Scenario.vehicle
(** The scenario's entry for it. *)

val set_out : t -> at:float -> charges:float option -> Track.t -> t
(** [set_out v ~at ~charges track] is [v] that leaves at time [at] and follows [track]. Its battery gains [charges] each
    hour; [None]: it is drained. *)

val rest : t -> at:float -> t
(** [rest v ~at] is [v] staying where it is at time [at]. *)

(** {1:state Its state}

    At a time not before the last command. *)

val position : t -> at:float -> Dolphin_geo.Position.t
(** Its place. *)

val battery : t -> at:float -> float
(** Its charge, from 0 to 1: {!Battery.level}. *)

val seen_at : t -> at:float -> Dolphin_geo.Position.t
(** Its reported place: {!position}, or if the scenario gives several places, the nearest of them. *)

val shown_battery : t -> at:float -> float option
(** The battery's reading: {!battery}, or if the scenario gives several values, the nearest of them; [None] if it
    reports none. *)

val speed : t -> at:float -> float
(** Over the ground, in metres per second. *)

val empty_from : t -> float
(** [empty_from v] is when the battery is empty, if [v] goes on as it does; [infinity] if never. *)

val is_steady : t -> at:float -> bool
(** [is_steady v ~at] is whether neither position nor battery change any more from [at] on, if [v] goes on as it
    does. *)
