(** Ways of searches around the most likely place, the datum, as the IAMSAR manual names them. All turns are to the
    right; bearings are those of the first leg, in degrees.

    {[
      open Dolphin_geo

      let () =
        match Search_pattern.sector Place.apdl ~radius:500. ~bearing:0. with
        | Ok way -> assert (Wgs84.distance Place.apdl (List.nth way (List.length way - 1)) < 0.1)
        | Error _ -> assert false

      let () =
        let square = Search_pattern.expanding_square Place.apdl ~radius:500. ~bearing:0. in
        assert (square ~spacing:0. = Error (Spacing 0.))
    ]} *)

(** A number that makes no pattern. [Bearing]: it is not finite. *)
type error =
  | Spacing of float  (** not above 0, or not finite *)
  | Radius of float  (** not above 0, or more than {!most_radius} *)
  | Bearing of float
  | Many_points of int  (** more than {!Area.most_points} *)

val expanding_square : Position.t -> spacing:float -> radius:float -> bearing:float -> (Position.t list, error) result
(** [expanding_square datum ~spacing ~radius ~bearing] has legs of [spacing], [spacing], [2 * spacing], [2 * spacing]
    and so on, each at right angles to the one before, until it has gone around the square with sides [2 * radius] and
    its middle at [datum]: each point of that square is at most [0.59 * spacing] away from a leg. *)

val sector : Position.t -> radius:float -> bearing:float -> (Position.t list, error) result
(** [sector datum ~radius ~bearing] are three triangles with sides of [radius], which meet at [datum]: out, across and
    back, always with turns of 120 degrees. It ends at [datum], on the course on which it began. *)

val spiral : Position.t -> spacing:float -> radius:float -> bearing:float -> (Position.t list, error) result
(** [spiral datum ~spacing ~radius ~bearing] turns around [datum], farther away by [spacing] with each turn, with a
    point every 10 degrees, and ends with a turn that is nowhere nearer than [radius - spacing / 2]. *)

val most_radius : float
(** 200 km. *)

val pp_error : Format.formatter -> error -> unit
(** One sentence without a full stop. *)
