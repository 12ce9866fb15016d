(** What is to ring when. *)

open Dolphin_semantics

type t

val none : t
(** Nothing is to ring. *)

val of_list : (Residual.timer * float) list -> t
(** Timers and when they ring. *)

val set : Residual.timer -> float -> t -> t
(** [set timer time x] rings [timer] at [time], after others at that time; no more when it was to ring before. *)

val cancel : Residual.timer -> t -> t
(** It does not ring any more. *)

val first : t -> float
(** When the next one rings; [infinity] if none does. *)

val rung : now:float -> t -> Residual.timer list * t
(** [rung ~now x] is the timers that have rung by [now], first one first, and the others. *)
