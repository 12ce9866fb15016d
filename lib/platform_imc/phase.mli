(** How far the execution of a plan on a vehicle has come, and the ways from one phase to another. What leads where is
    {!Execution}'s. *)

open Dolphin_imc

type order = {
  plan : string;
  specification : Message.t Message.Plan_specification.t option;  (** [None]: the vehicle knows the plan by name *)
}

type output =
  | Keep of Durable_note.t  (** In case that we die: before what follows is sent. *)
  | Send of Message.t  (** To the vehicle. *)
  | Done
  | Failed of string  (** Without a full stop. *)
  | Note of string  (** For people: a request sent again that may have an effect twice, a stop given up. *)

(** {1:sightings Sightings} *)

(** What the vehicle said of its plan, and when by its clock. *)
type sighting = { sent : float; state : Message.Plan_control_state.t }

val is : string -> sighting -> bool
(** [is plan s]: it named [plan]. *)

val busy : sighting -> bool
(** It is in one of the states in which a plan that runs, or has just been taken, is seen. *)

val succeeded : sighting -> bool
(** The last plan did. *)

val failed : sighting -> bool

(** {1:phases Phases} *)

(** An order as the vehicle was asked. *)
type attempt = {
  order : order;
  request : int;
  copies : int;  (** so many were sent *)
  last_sent : float;
  asked : float;  (** what the vehicle's clock showed at the last copy, at most *)
  before : sighting option;  (** what it had said last when the request was first sent *)
  after : float;  (** when, by its clock, it had said anything last then *)
  accepted : float option;  (** when it first answered that it takes the plan *)
  adopted : bool;  (** the request was a console's that has died *)
  initialised : bool;  (** INITIALIZING was seen *)
}

type phase =
  | Idle
  | Starting of attempt
  | Running of { attempt : attempt; since : float }
  | Ending of { attempt : attempt; since : float; why : string; deadline : float }
  (** It failed; the vehicle's words are awaited. *)
  | Stopping of {
      attempt : attempt;
      took_effect : bool;  (** the plan was seen to be taken *)
      stop : int;
      after : float;
      first_sent : float;
      last_sent : float;
      next : order option;
    }

type former = {
  attempt : attempt;
  ended : float;
  watched_until : float;
  given_up : bool;  (** it was not heard to be over: its link, or its stop's confirmation, was waited for in vain *)
}
(** The order before, over since [ended] by the vehicle's clock. If it is seen to run again before [watched_until], then
    because of a late copy of our request, or because it was given up. *)

type t = {
  next_request : int;
  seen : sighting option;
  error : (float * string) option;  (** the last error that the vehicle reported, and when *)
  abort : string option;
  last_stop : int option;
  stop_echo : float;  (** when the vehicle last answered a stop of ours *)
  former : former option;
  takes : Duplicates.t;  (** of the last request *)
  phase : phase;
}

val create : request:int -> t
(** Nothing to do; requests are numbered from [request]. *)

val idle : t -> bool
(** No order, and none to be undone. *)

val owes : t -> bool
(** As {!Execution.owes}. *)

val unsettled : t -> string option
(** As {!Execution.unsettled}. *)

val due : t -> float
(** When the passing of time matters next, in seconds; [infinity] if it does not. *)

(** {1:ways Ways} *)

val request : Message.Plan_control.Op.t -> int -> order -> Message.t option -> output
(** [request op n o arg] sends the request [n] to do [op] with the plan of [o]. *)

val begin_attempt : now:float -> clock:Vehicle_clock.t -> order -> t -> t * output list
(** To [Starting]. *)

val resend : now:float -> clock:Vehicle_clock.t -> attempt -> t -> t * output list
(** One copy more, in [Starting]. *)

val begin_stop :
  now:float -> clock:Vehicle_clock.t -> took_effect:bool -> ?next:order -> attempt -> t -> t * output list
(** To [Stopping]. *)

val close : ?watch:float -> now:float -> ended:float -> attempt -> t -> t
(** To [Idle]. The vehicle is watched for late copies of the request, {!echo} long, or [watch] from now. *)

val succeed : now:float -> ended:float -> attempt -> t -> t * output list
(** To [Idle], [Done]. *)

val fail : ?watch:float -> now:float -> ended:float -> attempt -> string -> t -> t * output list
(** To [Idle], [Failed]. *)

val expect_words : now:float -> clock:Vehicle_clock.t -> attempt -> since:float -> string -> t -> t * output list
(** [expect_words ~now ~clock a ~since why x] to [Ending]; if a late stop of the plan before did it, to [Starting]. *)

val start_again : now:float -> clock:Vehicle_clock.t -> attempt -> string -> t -> t * output list
(** To [Starting], with a note that says why. *)

val replaced : now:float -> clock:Vehicle_clock.t -> ended:float -> attempt -> string -> t -> t * output list
(** [replaced ... other x]: the vehicle executes, or has executed, the plan [other]. *)

val effect_of : attempt -> float
(** When, by the vehicle's clock, the order took effect, as far as is known. *)

val hit_by_late_stop : t -> since:float -> bool
(** Whether the vehicle answered a stop that was for an order before, after the plan ran at [since]: it may have
    stopped the wrong one. *)

val late_stop : string
(** What is told of it. *)

val words : t -> since:float -> why:string -> string
(** Why it failed, in the vehicle's words if there are any; in ours, [why]. *)

(** {1:constants Constants} Seconds. *)

val grace : float
(** As {!Execution.grace}. *)

val stop_interval : float
(** As {!Execution.stop_interval}. *)

val stop_patience : float
(** As {!Execution.stop_patience}. *)

val echo : float
(** 10 s: for so long after it was sent last, a datagram of ours may still arrive. *)

val remembrance : float
(** 600 s: for so long a plan that we gave up is stopped when the vehicle is heard again. *)
