(** The defaults of a fleet file. *)

val speed : kind:string -> float
(** [speed ~kind] in m/s: 18 for a ["UAV"], 1.5 for all others. *)

val battery : float
(** 1: full. *)

val drain : float
(** 0.1 an hour. *)

val failure : float
(** How often [mayFail] without a number fails: 0.1. *)

val position : int -> Dolphin_geo.Position.t
(** [position n] is the place of the [n]-th vehicle without a position, from 0: off the harbour of Leixões, in rows
    of ten, 20 m apart. *)
