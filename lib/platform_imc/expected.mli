(** Vehicles of a console that died and is taken over from, until they have said what they run. *)

open Dolphin_semantics
open Knowledge

val resume : now:float -> Dolphin_runtime.History.outstanding -> t -> t
(** As {!Station.resume}. *)

val order_of : Core.platform_task -> Execution.order
(** The order that the task is to a vehicle: an inline plan goes along, others are known by name. *)

val expect : Core.vehicle -> wish -> t -> t
(** [expect v wish s]: [wish] is to be done with [v] when it has said what it runs. *)

val halt : Core.vehicle -> begun -> t -> t
(** [halt v b s] expects [v] in order to halt [b], unless that is over, or was never asked for. *)

val deadline : now:float -> Core.vehicle -> t -> float
(** When a vehicle that was not heard till then has failed its task. *)

val receive : now:float -> Node.t -> t -> t * output list
(** [receive ~now n s] does what was wished of [n] if it has said what it runs. *)

val give_up : now:float -> t -> t
(** Tasks of vehicles that were not heard in time have failed. *)

val due : t -> float
(** When {!give_up} has something to do; [infinity] if never. *)

val owes_stop : t -> bool
(** Some vehicle is yet to be halted. *)

val plural : float -> string
(** ["1 second"], ["60 seconds"]. *)
