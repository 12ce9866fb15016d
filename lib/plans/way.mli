(** Where a way is cut: the arithmetic of {!Inline_plan.from_share}, for plans of either kind. *)

module Position = Dolphin_geo.Position

(** A leg of a way, whose [speed] in metres per second is known. *)
type leg = { waypoints : Position.t list; speed : float; dwell : float }

(** The earliest moment at which a share of the way is done, so that nothing which takes no time is left out. *)
type cut = {
  leg : int;  (** the leg under way, from 0 *)
  passed : int;  (** how many of its waypoints the vehicle has reached *)
  place : Position.t;
  stayed : float option;  (** seconds of its dwell, or [None] on the way to the next waypoint *)
}

val drop : int -> 'a list -> 'a list
(** [drop n xs] is [xs] without its first [n]. *)

val is_there : Position.t -> Position.t -> bool
(** [is_there p q] is whether [p] and [q] are one place, to the centimetre: nothing remains between them. *)

val seconds : leg list -> float
(** [seconds legs] is how long the way takes from the first waypoint on, dwells without end left out. *)

val cut : float -> leg list -> cut option
(** [cut x legs] is the moment at which the share [x] of the seconds from the first waypoint on has passed, the end for
    [x >= 1]. A dwell without end counts 0. [None] if [x] is not positive or there are no such seconds. *)
