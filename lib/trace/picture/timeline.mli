(** The picture's first part: time from left to right, a row for the program and for each vehicle. *)

val draw : Summary.t -> x:float -> y:float -> width:float -> Svg.t * float
(** [draw summary ~x ~y ~width] is the timeline with its upper left corner at [x], [y], and its height. *)
