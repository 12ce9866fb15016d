(** The timers that run, and when they expire. Times are seconds of our clock. *)

open Dolphin_semantics

type t

val none : t
(** No timer runs. *)

val of_list : (Residual.timer * float) list -> t
(** [of_list timers] is these timers, each with the time at which it expires. *)

val set : Residual.timer -> float -> t -> t
(** [set timer time x] is [x] with [timer] expiring at [time], after others at that time, and not when it was to expire
    before. *)

val cancel : Residual.timer -> t -> t
(** [cancel timer x] is [x] without [timer]. *)

val first : t -> float
(** When the next one expires; [infinity] if none runs. *)

val expired : now:float -> t -> Residual.timer list * t
(** [expired ~now x] is the timers that have expired by [now], the earliest first, and those that still run. *)
