(** The ways of the vehicles, seen from above, over a grid of latitudes and longitudes with a scale. *)

val draw : Summary.t -> x:float -> y:float -> width:float -> height:float -> Svg.t
(** [draw summary ~x ~y ~width ~height] is the map in this frame. North is up; a metre is as long in all directions. *)

val legend : Summary.t -> x:float -> y:float -> Svg.t list
(** What the lines of {!draw} mean where they do not all mean the same, in one line from [x] on the base line [y]. *)

val moments : Summary.t -> x:float -> y:float -> width:float -> height:float -> (float * (float * float)) list list
(** [moments summary ~x ~y ~width ~height] is where each vehicle is on this map, and when; in between they go
    straight. *)

val most_names : int
(** More names than that are not told apart; the timeline has them. *)

val line_height : float
(** Of names one below the other. *)

val height_for : int -> float
(** The height at which the names of so many vehicles stand one below the other; of more than {!most_names}, none
    stand there. *)

val thin : (float * float) list -> (float * float) list
(** [thin points] is [points] less those that could not be told from their neighbours in a picture. *)
