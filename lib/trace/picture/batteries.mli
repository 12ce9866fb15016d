(** The batteries of the vehicles over time. *)

val draw : Summary.t -> x:float -> y:float -> width:float -> height:float -> Svg.t
(** [draw summary ~x ~y ~width ~height] is the chart in this frame. It shows the range that the batteries go through,
    and not less than a twentieth of the whole. *)
