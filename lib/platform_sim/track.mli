(** Ways over the ground, and how fast they are gone: a position for every time. Times are seconds since the departure,
    lengths metres, speeds metres per second, more than 0. *)

open Dolphin_geo

type t

val stay : Position.t -> t
(** [stay p] is to be at [p], for 0 seconds. *)

(** How a leg goes up and down. *)
type vertical =
  | Level  (** as high as before *)
  | Reaching of { rate : float; stays_at : float; swing : swing option }
  (** on the way to each of the waypoints straight up or down to its height, at [rate] metres per second, and then as
      high; later to [stays_at] *)

(** Between the heights [low] and [high] at [slope] metres per second: while it stays, or if it does not, on the way. *)
and swing = { low : float; high : float; slope : float }

(** A part of a way: straight to each of [waypoints] in turn, then to stay for [dwell] seconds, perhaps [infinity].
    Going up and down takes no time of its own. *)
type leg = { waypoints : Position.t list; vertical : vertical; speed : float; dwell : float }

val through : Position.t -> leg list -> t
(** [through p legs] starts at [p]. *)

val there_and_back : Position.t -> Position.t -> speed:float -> duration:float -> t
(** [there_and_back p q ~speed ~duration] goes from [p] to [q], stays there and is back at [p] after [duration]; if it
    has to turn back before [q] for that, it does. Heights change evenly on the way. *)

val circuit : Position.t -> bearing:float -> speed:float -> duration:float -> t
(** [circuit p ~bearing ~speed ~duration] goes round in a circle for [duration] and ends where it begins, at [p]. The
    centre lies at course [bearing] from [p], 100 m to 200 m away, or less if a larger circle would take longer. *)

val duration : t -> float
(** [duration w] is when the end of [w] is reached; [infinity] if it has none. *)

val position : t -> float -> Position.t
(** [position w time] is the place after [time]; after the end, at the end. O(log n) in the number of waypoints. *)

val speed : t -> float -> float
(** [speed w time] is how fast one is after [time], over the ground; after the end, 0. *)

val still_from : t -> float
(** [still_from w] is the time from which the position does not change any more. *)
