(** The program's knowledge of the vehicles around it: the sensors' side of a configuration. The semantics only reads
    it; a driver keeps it up to date.

    {[
      open Dolphin_semantics

      let noptilus =
        { World.id = "noptilus-1"; kind = "UUV"; payload = [ "DVL" ]; position = Dolphin_geo.Place.apdl; depth = None;
          altitude = None; battery = Some 0.9; speed = None; readings = []; connected = true; unready = None;
          cruise = Some 1.5; drain = None; progress = [] }

      let world = World.add { noptilus with connected = false } (World.add noptilus World.empty)

      let () =
        assert (World.count world = 1);
        assert (World.carries [ "dvl" ] noptilus);
        assert (not (List.exists World.is_ready (World.vehicles world)))
    ]} *)

(** The latest reports of a vehicle. *)
type vehicle_state = {
  id : Core.vehicle;
  kind : string;  (** ["UUV"], ["UAV"], ["USV"], ["ROV"], ... *)
  payload : string list;  (** the devices that it carries *)
  position : Dolphin_geo.Position.t;
  depth : float option;  (** metres below the surface; [None]: not reported, or not in the water *)
  altitude : float option;
  (** metres above the ground, or above the point of take-off; [None]: not reported, or not flying *)
  battery : float option;  (** the charge, from 0 (empty) to 1 (full); [None]: not reported *)
  speed : float option;  (** over the ground, in metres per second; [None]: not reported *)
  readings : (string * float) list;  (** its last measurements, by quantity: ["Temperature"]; in order of these *)
  connected : bool;  (** whether it has a link *)
  unready : string option;
  (** the reason why it cannot be given a plan though it has a link, as a predicate: ["is in mode ERROR: leak"] *)
  cruise : float option;  (** metres per second where a plan has none; [None]: not reported *)
  drain : float option;  (** the share of its battery that an hour under way takes; [None]: not reported *)
  progress : (string * float) list;
  (** the shares of their ways that it has done of its plans, from 0 to 1, each with the
      {!Dolphin_plans.Inline_plan.digest} of the whole plan ([""] if its way is not known); the latest plan first. Only
      for programs that ask for them. *)
}

type t

(** In which order vehicles are picked. *)
type order =
  | By_hearing  (** the first one heard of first: a simulated fleet's order *)
  | By_id  (** the same in each run, however late announcements come: a network's *)

val nobody : order -> t
(** Nothing is known of any vehicle. *)

val empty : t
(** [nobody By_hearing]. *)

val add : vehicle_state -> t -> t
(** [add s w] is [w] in which vehicle [s.id] has state [s]. A vehicle keeps its place in the order. *)

val find : Core.vehicle -> t -> vehicle_state option
(** Its known state, if any. *)

val vehicles : t -> vehicle_state list
(** All vehicles ever heard of, in the order of [w]. *)

val is_ready : vehicle_state -> bool
(** [is_ready s] is whether [s] can be given a plan: it has a link, and nothing keeps it. *)

val only : Core.vehicle list -> t -> t
(** [only vs w] is [w] in which nothing was heard of other vehicles, and of [vs] in this order. *)

val count : t -> int
(** The number of {!vehicles}. *)

val carries : string list -> vehicle_state -> bool
(** [carries devices s] is whether [s] carries each of [devices]; names are compared without regard to case. *)

(** {1:open Worlds that leave something open}

    A driver knows what sensors show. An analysis of all that may happen does not: in an {e open} world, a sensor may
    show one of several values, or any value. The transition function then gives the transitions for all of them,
    each with its assumptions. Within one step a sensor does not change; in the next step it may show another value. *)

type assumption =
  | Late of Core.vehicle  (** it was first heard of after all others so far *)
  | Missing of Core.vehicle  (** it is not in reach *)
  | Sensed of Core.sensor * Core.vehicle * Core.value  (** this sensor of it shows this *)
  | Placed of Core.vehicle * Dolphin_geo.Position.t  (** it is seen there *)
  | Claim of string * bool  (** this comparison with a sensor's value holds, or does not *)

val compare_assumption : assumption -> assumption -> int
(** A total order. *)

val contradict : assumption -> assumption -> bool
(** [contradict a b] is whether no moment has both: a comparison has both outcomes, a sensor shows two values, or no
    number satisfies two comparisons of one quantity with numbers. *)

val pp_assumption : Format.formatter -> assumption -> unit
(** ["battery(x8-02) is 0.2"], ["battery(x8-02) < 0.3 is true"], ["x8-02 is missing"]. *)

val open_sensor : Core.sensor -> Core.vehicle -> Core.value list -> t -> t
(** [open_sensor s v xs w] is [w] in which the sensor [s] of [v] has one of [xs], at each look of the program; with
    an empty [xs], any value. If [v] has not reported it, it stays unknown. *)

val open_battery : Core.vehicle -> float list -> t -> t
(** [open_battery v xs] is [open_sensor Battery v] of the numbers [xs]. *)

val open_position : Core.vehicle -> Dolphin_geo.Position.t list -> t -> t
(** The same for the place of [v]. *)

(** The date: how many whole seconds have passed since the start of the run. *)
type date =
  | Exactly of int
  | Since of int  (** open, but compared with a number it is as this one *)
  | Any

val at : date -> t -> t
(** [at d w] is [w] with the date [d]. Worlds begin at [Exactly 0]. *)

val whole : float -> int
(** [whole s] is how many seconds have passed by [s], to the millisecond. *)

val is_open : t -> bool
(** Whether some sensor may show several values, or the date is open. *)

val suppose : assumption list -> t -> t
(** [suppose assumed w] is [w] in which [assumed] holds: its subject is no longer open. *)

(** {1:look What is looked at} *)

(** The possible values of a sensor. *)
type 'a shown =
  | Shows of 'a
  | One_of of 'a list  (** that is open: any of these *)
  | Anything

val spell : Core.sensor -> Core.vehicle -> string
(** ["battery(x8-02)"], ["reading(x8-02,'Temperature')"]: no two sensors are spelt alike. *)

val sensor : t -> Core.sensor -> vehicle_state -> Core.value shown option
(** [sensor w s state] is the value of that sensor of the vehicle; [None] if not reported. *)

val sensors : t -> vehicle_state -> (Core.sensor * Core.value shown option) list
(** [sensors w state] is {!sensor} of all that the vehicle has. *)

val position : t -> vehicle_state -> Dolphin_geo.Position.t shown
(** [position w s] is the place of [s]. *)

val date : t -> date
(** The date of the world, as {!at} sets it. *)

type question = assumption list
(** The open values, by the possible assumptions: one of these, and no two of them. *)

val values : Core.sensor -> vehicle_state -> Core.value list -> question
(** [values s state xs] is the question which of [xs] that sensor of the vehicle shows. *)

val places : vehicle_state -> Dolphin_geo.Position.t list -> question
(** [places s ps] is the question at which of [ps] [s] is seen. *)

val places_of : t -> vehicle_state -> Dolphin_geo.Position.t list
(** [places_of w s] is all values that {!place} may have. *)

val place : t -> vehicle_state -> (Dolphin_geo.Position.t, question) result
(** [place w s] is the place of [s], or if that may be anywhere, [s.position]: for picking and allocating. *)

val claim : t -> string -> (bool, question) result
(** [claim w text] is whether a comparison with an open value holds: open, unless some claim that was supposed of [w]
    decides it. *)

val claims : t -> int
(** [claims w] is how many claims were supposed of [w]. *)
