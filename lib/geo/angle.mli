(** Angles in the two units of the trade. *)

val radians : float -> float
(** [radians degrees] is [degrees * pi / 180]. *)

val degrees : float -> float
(** [degrees radians] is [radians * 180 / pi]. *)
