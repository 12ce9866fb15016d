(** Axes: the places of round numbers. *)

val step : most:int -> float -> float
(** [step ~most span] is the least of 1, 2 and 5 times a power of ten that divides [span] into at most [most] parts. *)

val time_step : most:int -> float -> float
(** The same for seconds, in steps that clocks have: 1 s, 2 s, 5 s, 10 s, 15 s, 30 s, 1 min ... *)

val multiples : float -> from:float -> until:float -> float list
(** [multiples step ~from ~until] is the multiples of [step] in between, ends included. At most a thousand. *)

val decimals : float -> int
(** [decimals step] is how many digits after the point multiples of [step] need. *)

val spread : least:float -> from:float -> until:float -> (float * 'a) list -> (float * 'a) list
(** [spread ~least ~from ~until labels] moves labels, each with the place that it would like best, so that they are
    [least] apart, in order of place, and if possible in between. *)
