(** The ways of the vehicles, seen from above, over a grid of latitudes and longitudes with a scale. *)

val draw : Summary.t -> x:float -> y:float -> width:float -> height:float -> Svg.t
(** [draw summary ~x ~y ~width ~height] is the map in this frame. North is up; a metre is as long in all directions. *)

val legend : Summary.t -> x:float -> y:float -> Svg.t list
(** The meaning of the lines of {!draw} if there are several meanings, in one line from [x] on the base line [y]. *)

val moments : Summary.t -> x:float -> y:float -> width:float -> height:float -> (float * (float * float)) list list
(** [moments summary ~x ~y ~width ~height] is the places of each vehicle on this map, with times; in between they go
    straight. *)

val most_names : int
(** Further names are not distinguished; the timeline has them. *)

val line_height : float
(** Of names one below the other. *)

val height_for : int -> float
(** The height of a column of this number of names; with more than {!most_names}, no names are drawn. *)

val thin : (float * float) list -> (float * float) list
(** [thin points] is [points] less those too close to their neighbours to be seen in a picture. *)
