(** Parallel lines over a polygon on the ground. *)

val lines : Position.t list -> spacing:float -> bearing:float -> Position.t list
(** [lines corners ~spacing ~bearing] is the ends of the lines that cover the polygon of [corners], at most [spacing]
    metres apart, along [bearing] (degrees), there and back again, in the order in which they are flown: each line is
    two of them, or more where the polygon is not convex. [[]] if there are fewer than three corners. *)

val count : Position.t list -> spacing:float -> bearing:float -> float
(** [count corners ~spacing ~bearing] is how many lines there are, without making them. *)

val around : Position.t -> radius:float -> Position.t list
(** [around p ~radius] is the corners of a polygon of 16 sides around the disc of [radius] metres at [p]. *)
