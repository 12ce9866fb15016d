(** Ways over the ground, and how fast they are gone: a position for every time. Times are seconds since the departure,
    lengths metres, speeds metres per second, more than 0. *)

open Dolphin_geo

type t

val stay : Position.t -> t
(** [stay p] is to be at [p], for 0 seconds. *)

(** A part of a way: straight to each of [waypoints] in turn, then to stay for [dwell] seconds, perhaps [infinity]. *)
type leg = { waypoints : Position.t list; speed : float; dwell : float }

val through : Position.t -> leg list -> t
(** [through p legs] starts at [p]. *)

val there_and_back : Position.t -> Position.t -> speed:float -> duration:float -> t
(** [there_and_back p q ~speed ~duration] goes from [p] to [q], stays there and is back at [p] after [duration]; if it
    has to turn back before [q] for that, it does. *)

val circuit : Position.t -> bearing:float -> speed:float -> duration:float -> t
(** [circuit p ~bearing ~speed ~duration] goes round in a circle for [duration] and ends where it begins, at [p]. The
    centre lies at course [bearing] from [p], 100 m to 200 m away, or less if a larger circle would take longer. *)

val duration : t -> float
(** [duration w] is when the end of [w] is reached; [infinity] if there is none. *)

val position : t -> float -> Position.t
(** [position w time] is where one is after [time]; after the end, at the end. O(log n) in the number of waypoints. *)

val speed : t -> float -> float
(** [speed w time] is how fast one is after [time], over the ground; after the end, 0. *)

val still_from : t -> float
(** [still_from w] is the time from which the position does not change any more. *)
