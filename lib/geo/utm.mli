(** The Universal Transverse Mercator grid, read. *)

(** Which half of the globe a grid position is in. *)
type half = North | South

val position : zone:int -> half -> easting:float -> northing:float -> (Position.t, string) result
(** [position ~zone half ~easting ~northing] is the position on the ellipsoid with these coordinates in metres, or
    the reason why there is none: an unknown zone, or metres outside of any zone. Krüger's series to the sixth power
    of the third flattening: its error is below a micrometre in a zone and its neighbours. *)

val band : float -> char option
(** [band latitude] is the letter of the band of 8 degrees that [latitude] is in, from [C] at 80 degrees south to [X],
    which ends at 84 degrees north; [None] beyond. *)
