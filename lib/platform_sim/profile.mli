(** Heights over time: metres above the ellipsoid, for each second since the departure. *)

type t

(** How a vehicle is up or down during a part of its way. *)
type course =
  | Keep  (** as high as before *)
  | Reach of { height : float; rate : float }  (** straight there, at [rate] metres per second, and then as high *)
  | Swing of { low : float; high : float; slope : float; rate : float }
  (** down to [low] and up to [high] again and again, at [slope] metres per second; first at [rate] to the nearest
      point of that *)

(** A part of the way. *)
type phase = { lasts : float;  (** seconds, perhaps [infinity] *) course : course }

val make : float -> phase list -> t
(** [make height phases] begins at [height]. Rates are more than 0; a swing without height or slope is not one, and
    one without an end stays in the middle. *)

val height : t -> float -> float
(** [height p time] is how high one is after [time] seconds; after the end, as at the end. O(log n). *)

val still_from : t -> float
(** [still_from p] is the time from which the height does not change any more. *)
