(* The runtime's requirements on a platform: on a network of vehicles, real or simulated. A types-only module: it has no
   interface of its own. [Dolphin_platform_sim] is the first platform and the tutorial for authors of others.

   A platform decides nothing about programs. It reports events, and carries out requests. *)

open Dolphin_semantics

type event =
  | Vehicle of World.vehicle_state
  (* First heard of, or changed: connection at once, position and battery at least while {!S.telemetry} is not [Off]. *)
  | Task_done of Core.vehicle
  | Task_failed of Core.vehicle * string
  (* In the vehicle's own words: it failed, refused, or its link was lost for longer than its connection timeout. *)
  | Timer of Residual.timer
  | Input of string * Core.value
  (* A pair is posted: only a platform that plays the people too knows. *)
  | Quiet
  (* Nothing will ever happen again by itself, and if telemetry is {!Awaited}, no position or battery will change: only
     a platform of virtual time can know. *)

(* How changes of positions and batteries are reported. *)
type telemetry =
  | Off
  | Shown  (* for displays and journals: the program's behaviour is the same as with [Off] *)
  | Awaited  (* the program reads sensors *)

module type S = sig
  type t

  val name : string
  (** As users know it: ["sim"]. *)

  val virtual_time : bool
  (** Whether time passes only inside {!next}. A driver then does not call {!next} while it waits for people or other
      processes. *)

  val order : World.order
  (** In which order programs pick its vehicles. *)

  val now : t -> float
  (** Seconds since the platform started, by its own clock. *)

  val announce_period : t -> float
  (** The seconds after which every vehicle in reach has been heard of: how long a [pick] without a timeout looks. *)

  val next : t -> event Lwt.t
  (** [next p] is the next event, when it comes. Nothing else calls it before it resolves, or is cancelled. *)

  val set_timer : t -> Residual.timer -> float -> unit
  (** [set_timer p timer seconds] makes the event [Timer timer] happen after [seconds]. *)

  val cancel_timer : t -> Residual.timer -> unit
  (** The event of this timer no longer happens. A timer that expired, or was never set, is not an error. *)

  val bind : t -> Core.vehicle list -> unit
  (** The program holds these vehicles now. *)

  val release : t -> Core.vehicle list -> unit

  val start : t -> number:int -> Core.vehicle -> Core.platform_task -> unit
  (** [start p ~number v task] makes [v] run [task], once it has confirmed a stop under way. [Task_done v] or
      [Task_failed (v, why)] follows, unless {!stop} comes first. [number] is that of the START among the transitions of
      the run, from 0: with the run's identity it identifies this start, also for a console that resumes the run. *)

  val stop : t -> Core.vehicle -> unit
  (** [stop p v] stops what [v] runs for the program. No event about that task follows: {!next} gives none, and a
      receiver that has been given one and not read it yet drops it ({!Overtaken}). *)

  val set_connection_timeout : t -> Core.vehicle list option -> float -> unit
  (** For these vehicles, or for all, present and future; seconds. *)

  val telemetry : t -> telemetry -> unit
  (** Unless [Off], changes of positions and batteries are events, about once a second. The position of a vehicle that
      ends a task is an event in any case, just before that end. *)

  val look : t -> World.vehicle_state list
  (** [look p] is the present state of the vehicles that were stopped and have not been reported since, in virtual
      time; [[]] if time passes by itself, since {!next} reports them then. A driver looks before the program goes
      on: the next allocation may depend on the places where they stopped. *)

  val close : t -> unit Lwt.t
  (** Resolves once every stop is confirmed or given up, and the platform's resources are closed. *)
end
