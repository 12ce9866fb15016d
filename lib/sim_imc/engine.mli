(** The engine of plans in a vehicle: requests in, plans flown, replies and states out. A pure state machine.

    It behaves as DUNE 2026.01 was measured to:
    - A START that is accepted shows as: PlanControlState INITIALIZING, which still names the plan before; the reply
      ["plan loaded"]; VehicleState MANEUVER; PlanControlState EXECUTING; the reply ["1: executing maneuver"], of the
      first maneuver only. At the end come VehicleState with the flag of a maneuver that is done, the reply
      ["plan completed"], PlanControlState READY with outcome SUCCESS, VehicleState SERVICE.
    - A START that is refused: INITIALIZING, a FAILURE reply, READY, both with the plan id before, outcome FAILURE.
    - Any START ends the plan that is running, accepted or not; that plan gets no further reply.
    - A plan that comes with a START is kept, refused or not, and known by its name from then on; a reply of PlanDB
      reports it.
    - The log book records all this, see {!Log_book}.
    - With the flag CALIBRATE the plan begins 3 s later; until then the state is INITIALIZING.
    - STOP: a SUCCESS reply, READY, outcome FAILURE; without a plan a FAILURE reply.
    - Abort: a FAILURE reply to the START of the plan that was running, VehicleState ERROR, BLOCKED; after 0.9 s SERVICE
      and READY.
    - An engine that has stalled loses its plan: BLOCKED, and STOP is answered by FAILURE ["no plan is running, request
      ignored"], while VehicleState stays MANEUVER and the vehicle goes on to the end of its maneuver. Abort ends that.
    - The last outcome stays until the next. The statistics in a reply are those of the last plan that was loaded.
    - A START of the plan [dislodge] is ignored.

    Assumed, not measured: while BLOCKED a START is answered by FAILURE ["vehicle is blocked"] and changes nothing;
    other requests than START and STOP are answered by FAILURE.

    All times are seconds of the mission since its start, whatever clock the outside has. *)

open Dolphin_imc
open Dolphin_scenario

(** The constants. *)
type settings = {
  vehicle : Scenario.vehicle;
  plans : Scenario.plan list;
  samples : Scenario.sample list;  (** of the fields that it measures *)
  seed : int;  (** decides what the scenario leaves to chance, see {!Dolphin_platform_sim.Draw} *)
  epoch : float;  (** when the mission starts, in seconds since 1970 *)
  strict : bool;  (** whether plans that the scenario does not have are unknown *)
  refuses : string option;  (** why it refuses every START, if it does *)
  blocks : (float * float) list;  (** since when and for how long it is under external control and BLOCKED *)
  losses : float list;  (** when its plan engine loses the plan that it runs *)
}

type t

val create : settings -> t
(** [create s] has run no plan. *)

(** {1:outputs What comes of it} *)

(** Someone who asks for something: a system and the entity in it. *)
type party = { system : int; entity : int }

(** A message from an entity of the vehicle. *)
type outgoing = { from : int; to_ : party; message : Message.t }

type outcome = outgoing list * Activity.t list * t
(** The messages to send, in order; the log entries; the engine afterwards. *)

(** {1:time Time} *)

val due : t -> float option
(** When something happens by itself. *)

val advance : at:float -> t -> outcome
(** [advance ~at e] is all that happens by itself until [at]. The functions below take an engine that has been advanced
    to [at]. *)

(** {1:requests Requests} *)

val request : at:float -> sent:float -> by:party -> Message.t Message.Plan_control.t -> t -> outcome
(** A PlanControl for this vehicle, with the time stamp [sent]. Replies of others are ignored. *)

val abort : at:float -> by:party -> name:string -> t -> outcome
(** An Abort, sent by the system that calls itself [name]. *)

(** {1:state Its state} *)

val plan_control_state : at:float -> t -> Message.Plan_control_state.t
(** Its report on its plan. *)

val vehicle_state : t -> Message.Vehicle_state.t
(** Its report on itself. *)

val position : at:float -> t -> Dolphin_geo.Position.t
(** Its place. *)

val battery : at:float -> t -> float
(** The charge, as a share of 1. *)

val is_under_way : t -> bool
(** Whether a plan moves the vehicle. *)

(** {1:entities Entities of the vehicle} *)

val entity : int
(** Of the plan engine: 55. *)

val supervisor : int
(** Of VehicleState: 75. *)
