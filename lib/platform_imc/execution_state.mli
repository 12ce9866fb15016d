(** The phase of a plan on a vehicle, and the moves from phase to phase: the state of {!Execution}, which decides
    when they are made. *)

open Dolphin_imc

(** {!Execution.output}. *)
type output = Keep of Durable_note.t | Send of Message.t | Done | Failed of string | Remark of string

(** How far the plan of this console has come on the vehicle. Times are of our clock, but for [since] and [over], which
    are of the vehicle's. *)
type phase =
  | Idle
  | Starting of Attempt.t
  | Running of { attempt : Attempt.t; since : float }
  | Ending of { attempt : Attempt.t; since : float; why : string; deadline : float }
  (** It failed; the vehicle's words are awaited. *)
  | Stopping of {
      attempt : Attempt.t;
      took_effect : bool;  (** the plan was seen to be taken *)
      stop : int;
      after : float;
      over : float option;
      (** since when, by its clock, the vehicle's plan engine is known not to run the plan; the vehicle itself may *)
      first_sent : float;
      last_sent : float;
      aborted : float option;  (** when it was last ordered to abort, by our clock *)
      warned : bool;  (** people have the message that it goes on *)
      next : Attempt.order option;
    }

(** The attempt before, over since [ended] by the vehicle's clock. If the plan is seen to run again before
    [watched_until], then because of a late copy of our request, or because it was given up. *)
type former = {
  attempt : Attempt.t;
  ended : float;
  watched_until : float;
  given_up : bool;  (** it was not heard to be over: its link, or its stop's confirmation, was waited for in vain *)
  unrested_until : float;
  (** until then, by our clock, a vehicle that still maneuvers does so for this plan; [neg_infinity] once it rested *)
}

type t = {
  next_request : int;
  latest : Plan_report.t option;
  mode : (float * Message.Vehicle_state.Op_mode.t) option;  (** of the latest VehicleState, and when it was sent *)
  error : (float * string) option;  (** the last error that the vehicle reported, and when *)
  log_errors : Log_errors.t;
  intervention : string option;  (** the action of another console on the plan, in words *)
  last_stop : int option;
  stop_echo : float;  (** when the vehicle last answered a stop of ours *)
  former : former option;
  duplicates : Duplicates.t;  (** of the last request *)
  abort_after : float;  (** the time after a first STOP when a vehicle that still maneuvers is ordered to abort *)
  may_run : int option;
  (** the request that is noted to linger: its plan is over for the program, and the vehicle may still run it *)
  phase : phase;
}

val create : ?abort_after:float -> request:int -> unit -> t
(** {!Execution.create}. *)

val attempt : t -> (Attempt.t * Attempt.stage) option
(** The request that is not over yet, and how far it has come. *)

val grace : float
(** 1 s: how long the vehicle's words are awaited. *)

val late_copies : float
(** 10 s: the time after its last sending in which a datagram of ours may still arrive. *)

(** {1 From phase to phase}

    [now] is the time by our clock. *)

val begin_attempt : now:float -> clock:Vehicle_clock.t -> Attempt.order -> t -> t * output list
(** Requests a plan. *)

val send_again : now:float -> clock:Vehicle_clock.t -> Attempt.t -> t -> t * output list
(** Requests it once more. *)

val begin_stop :
  now:float -> clock:Vehicle_clock.t -> took_effect:bool -> ?next:Attempt.order -> Attempt.t -> t -> t * output list
(** Orders the vehicle to stop it; [next] is to be requested then. *)

val close : ?watch:float -> ?ours:bool -> now:float -> ended:float -> Attempt.t -> t -> t
(** [close ~watch ~ours ~now ~ended a x]: [a] is over since [ended]. The vehicle is watched for late copies of the
    request, or [watch] seconds from now. [ours]: if it still maneuvers, it does so for [a]; by default if the plan was
    seen to be taken. *)

val fail : ?watch:float -> ?ours:bool -> now:float -> ended:float -> Attempt.t -> string -> t -> t * output list
(** {!close}, and reports why it failed. *)

val succeed : now:float -> ended:float -> Attempt.t -> t -> t * output list
(** {!close}, and reports that it is done. *)

(** {2 What VehicleState shows} *)

val maneuvers : since:float -> t -> bool
(** [maneuvers ~since x]: the latest VehicleState was sent after [since] and reports that the vehicle maneuvers, or
    is about to. *)

val rests : since:float -> t -> bool
(** [rests ~since x]: the latest VehicleState was sent at [since] or later and reports that no maneuver runs. *)

(** {2 Where something else may have ended it} *)

val hit_by_late_stop : t -> since:float -> bool
(** Whether a stop of an earlier plan arrived late and ended this one, which began at [since]. *)

val late_stop : string
(** That, in words. *)

val start_again : now:float -> clock:Vehicle_clock.t -> Attempt.t -> string -> t -> t * output list
(** Requests it again, and remarks why. *)

val await_words : now:float -> clock:Vehicle_clock.t -> Attempt.t -> since:float -> string -> t -> t * output list
(** It failed, for that reason, unless the vehicle gives a better one in a moment; or is started again. *)

val replaced : now:float -> clock:Vehicle_clock.t -> ended:float -> Attempt.t -> string -> t -> t * output list
(** The vehicle executes, or has executed, that plan. *)

val words : t -> since:float -> why:string -> string
(** Why it failed, in the vehicle's words if there are any, else [why]. *)
