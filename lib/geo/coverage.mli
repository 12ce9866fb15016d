(** Ways that cover an area by parallel strips, as a lawnmower does. *)

type settings = {
  spacing : float;  (** metres that a strip covers, half of them on either side of it *)
  bearing : float option;  (** degrees clockwise from north; the best of the tried ones by default *)
  overlap : float;  (** the share of a strip that its neighbour covers too, from 0 to {!most_overlap} *)
  turn : float;  (** metres by which strips run on at both ends *)
}

(** The reason why there is no way: a setting out of its range, as {!settings} has it, or an area that cannot be
    covered. *)
type error =
  | Spacing of float  (** not above 0, or not finite *)
  | Wide of { spacing : float; across : float }  (** the area is nowhere as wide as a strip *)
  | Bearing of float
  | Overlap of float
  | Turn of float
  | Area of Area.error

val points : settings -> Area.t -> (Position.t list, error) result
(** [points settings area] is a way along straight strips, and between them:

    - each point of [area] is at most [spacing / 2] away from a strip;
    - strips, without their turns, are nowhere farther than [spacing / 2] from [area]: a strip is as long as the part
      that it covers, so it runs on beyond a rim that slants;
    - a way from strip to strip, without turns, is at most [1.5 * spacing] away from a connected area.

    Up to a thousandth of [spacing], and a millimetre in 2 km as on any {!Plane}. For their order see {!Tour.shortest}.
    Bearings that are tried are 12, and those of the 4 longest sides; 4 and 2 of areas with more than 300 corners, and
    of these, if they come to many strips, those with the least to go along strips. At
    most {!Area.most_points}, else [Error (Area Intricate)]. *)

val most_overlap : float
(** 0.9. *)

val pp_error : Format.formatter -> error -> unit
(** One sentence without a full stop. *)
