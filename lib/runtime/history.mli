(** The history of a run whose console died, as far as its platform has to know it in order to resume. *)

open Dolphin_semantics

(** A line of a journal, as far as platforms have to know it. *)
type what =
  | Saw of World.vehicle_state  (** The journal's line about the vehicle. *)
  | Noted of Core.vehicle * Yojson.Safe.t  (** The platform kept this note. *)
  | Happened of Transition.event
  | Asked of { number : int; effects : Effect.t list }  (** of the transition of this number *)

type entry = { time : float; what : what }
(** [time] is the platform's, in seconds. *)

type t = entry list
(** In order of time. *)

val part : vehicles:(Core.vehicle -> bool) -> timers:bool -> t -> t
(** [part ~vehicles ~timers history] is the part of [history] about [vehicles], and about all vehicles; without
    [timers] none was ever set. *)

(** {1:outstanding What is outstanding} *)

(** A task that a vehicle was ordered to run, and that is not known to be over. *)
type commanded = {
  task : Core.platform_task;
  number : int;  (** of the transition that commanded it, as {!Platform.S.start} got it *)
  is_again : bool;  (** The vehicle was commanded a plan of this name earlier in the run. *)
  is_stopped : bool;  (** It was ordered to stop it again. *)
  notes : Yojson.Safe.t list;  (** of the platform, since the task was to start; latest first *)
  before : commanded option;
  (** The task that was outstanding when this one was commanded; [notes] may show whether it is over. *)
}

(** The commands to a platform that are in force at the end of a history. *)
type outstanding = {
  bound : Core.vehicle list;
  tasks : (Core.vehicle * commanded) list;
  timers : (Residual.timer * float) list;  (** with the time at which they expire *)
  timeout : float option;  (** seconds: of the connections of all vehicles, if it was set *)
  timeouts : (Core.vehicle * float) list;  (** seconds: of those that have one of their own *)
}

val outstanding : announce_period:float -> t -> outstanding
(** [outstanding ~announce_period history] is the outstanding tasks after [history]. A [pick] without a timeout looks
    for [announce_period] seconds. *)

val answers : t -> (string * string) list
(** [answers history] is the questions that were answered, with the answers, in order. *)

val replies : t -> (string * (Core.value, string) result option) list
(** [replies history] is the calls of the host by their names ({!Machine.name_of_call}), in order, with the replies;
    [None] for a call without one yet. *)
