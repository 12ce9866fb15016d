(** What a run was before its console died, as its platform has to know it to go on. *)

open Dolphin_semantics

type what =
  | Saw of World.vehicle_state  (** This is what the journal says of the vehicle from then on. *)
  | Noted of Core.vehicle * Yojson.Safe.t  (** The platform wanted this to be found again. *)
  | Happened of Transition.event
  | Asked of Effect.t list  (** by one transition *)

type moment = { time : float; what : what }

(** {1:standing What stands} *)

(** What a vehicle was asked for, as far as nothing says that it is over. *)
type errand = {
  task : Core.platform_task;
  is_stopped : bool;  (** It was asked to stop. *)
  notes : Yojson.Safe.t list;  (** of the platform, since the task was to start; latest first *)
  before : errand option;  (** The vehicle was to stop this one before; [notes] may say whether it has. *)
}

type standing = {
  bound : Core.vehicle list;
  errands : (Core.vehicle * errand) list;
  timers : (Residual.timer * float) list;  (** with the time at which they expire *)
  timeout : float option;  (** of the connections of all vehicles, if it was set *)
  timeouts : (Core.vehicle * float) list;  (** of those that have one of their own *)
}

val standing : announce_period:float -> moment list -> standing
(** [standing ~announce_period moments] is what [moments], in order, come to. A [pick] without a timeout looks for
    [announce_period]. *)

val answers : moment list -> (string * string) list
(** The questions that were answered, with the answers, in order. *)

val calls : moment list -> int
(** How many calls the host has replied to. *)
