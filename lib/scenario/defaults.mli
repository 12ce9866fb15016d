(** What a fleet file need not say. *)

val speed : kind:string -> float
(** [speed ~kind] in m/s: 18 for a ["UAV"], 1.5 for all others. *)

val battery : float
(** 1: full. *)

val drain : float
(** 0.1 an hour. *)

val failure : float
(** How often [mayFail] without a number fails: 0.1. *)

val position : int -> Dolphin_geo.Position.t
(** [position n] is where the vehicle that is the [n]-th without a position, from 0, waits: off the harbour of Leixões,
    in rows of ten, 20 m apart. *)
