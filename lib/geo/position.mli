(** A point near the Earth's surface, in the WGS84 frame.

    {[
      open Dolphin_geo

      let () =
        assert (Result.is_ok (Position.make ~latitude:41.185 ~longitude:(-8.7062) ~height:0.));
        match Position.make ~latitude:91. ~longitude:0. ~height:0. with
        | Error fault -> assert (fault = Latitude 91.)
        | Ok _ -> assert false
    ]} *)

type t = {
  latitude : float;  (** degrees, north positive, from -90 to 90 *)
  longitude : float;  (** degrees, east positive, from -180 to 180 *)
  height : float;  (** metres above the WGS84 ellipsoid, from {!lowest} to {!highest} *)
}

(** The fault of three numbers that are not a position. *)
type error =
  | Latitude of float  (** degrees; not a number, or beyond a pole *)
  | Longitude of float  (** degrees; not a number, or not from -180 to 180 *)
  | Height of float  (** metres; not a number, or not from {!lowest} to {!highest} *)

val lowest : float
(** -20,000 metres: twice as deep as any sea. *)

val highest : float
(** 1,000,000 metres: no vehicle flies there. *)

val make : latitude:float -> longitude:float -> height:float -> (t, error) result
(** [make ~latitude ~longitude ~height] is the position with these coordinates (degrees, degrees, metres), or
    the first of them that is out of range. *)

val at_height : float -> t -> t
(** [at_height h p] is [p] at the height [h], or at the nearest one from {!lowest} to {!highest}. *)

val equal : t -> t -> bool
(** [equal a b] is [compare a b = 0]. *)

val compare : t -> t -> int
(** [compare] orders by latitude, then longitude, then height, as plain numbers: longitudes -180 and 180 differ. *)

val pp : Format.formatter -> t -> unit
(** ["(LATITUDE, LONGITUDE)"] with six decimals, about a decimetre; a height other than 0 follows, as
    [", HEIGHT m"] with one decimal. *)

val pp_error : Format.formatter -> error -> unit
(** One sentence without a full stop: the wrong number, and the right range. *)
