(** The ways of the vehicles, seen from above, over a grid of latitudes and longitudes with a scale. *)

val draw : Summary.t -> x:float -> y:float -> width:float -> height:float -> Svg.t
(** [draw summary ~x ~y ~width ~height] is the map in this frame. North is up; a metre is as long in all directions. *)

val height_for : int -> float
(** The height at which the names of so many vehicles stand one below the other; of more than 60, none stand there. *)

val thin : (float * float) list -> (float * float) list
(** [thin points] is [points] less those that could not be told from their neighbours in a picture. *)
