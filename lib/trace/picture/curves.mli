(** The reports of vehicles over time, one curve each. *)

type quantity
(** A quantity that vehicles report. *)

val batteries : quantity
(** Charges, from 0 to 1. *)

val heights : quantity
(** Metres above the ellipsoid; below the surface they are less than 0. *)

val has_heights : Summary.t -> bool
(** Whether some vehicle was half a metre above or below 0. *)

val draw : quantity -> Summary.t -> x:float -> y:float -> width:float -> height:float -> Svg.t
(** [draw q run ~x ~y ~width ~height] has the names of vehicles at the ends of their curves. *)
