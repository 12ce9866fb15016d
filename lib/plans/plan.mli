(** Inline plans: the content of [imcPlan { ... }], ready for any platform that flies maneuvers. *)

(** The unit of a maneuver's speed. *)
type speed_unit = Metres_per_second | Revolutions_per_minute | Percent  (** of full thrust *)

(** The reference of a [z]: metres below the surface, above the ground, above the ellipsoid; or the vehicle's own way
    of keeping its height, for any [z]. *)
type z_unit = Depth | Altitude | Height | Unspecified

(** The directions in which IMC lets a vehicle go round; with [Vehicle_dependent] the vehicle chooses. *)
type direction = Vehicle_dependent | Clockwise | Counter_clockwise | Into_wind_or_current

(** A device that a maneuver switches on, with its parameters by name. *)
type payload = { name : string; parameters : (string * string) list }

(** The action; lengths in metres, times in seconds, angles in degrees. Durations are whole, from 0 to 65535: 0 is
    without end, but for [Pop_up]. *)
type kind =
  | Go_to
  | Loiter of { radius : float; duration : float; direction : direction }
  | Yo_yo of {
      amplitude : float;  (** from the shallowest to the deepest point; [z] is half-way *)
      pitch : float;
    }
  | Pop_up of { duration : float; current_position : bool; wait_at_surface : bool; station_keep : bool }
  | Station_keeping of { radius : float; duration : float }
  | Compass_calibration of {
      amplitude : float;  (** up and down from [z], as in IMC *)
      radius : float;
      pitch : float;
      duration : float;
      direction : direction;
    }
  | Launch
  | Rows of {
      bearing : float;
      cross_angle : float;
      width : float;
      length : float;
      horizontal_step : float;
      curve_offset : float;
      alternation : float;  (** percent *)
      square_curve : bool;
      first_curve_right : bool;
    }
  | Follow_path of (float * float * float) list  (** north, east, down from the maneuver's location *)

(** A maneuver with its place, its speed and its height. *)
type maneuver = {
  id : string;  (** ["1.Goto"], ["2.Loiter"]: unique in its plan *)
  kind : kind;
  location : Dolphin_geo.Position.t;  (** its starting place *)
  speed : float * speed_unit;
  z : float * z_unit;
  payloads : payload list;
}

type t = {
  name : string;
  description : string;
  vehicles : string list;  (** the only ones that may run it; [[]]: any *)
  maneuvers : maneuver list;  (** in order, at least one *)
}

val required_payload : t -> string list
(** [required_payload p] names the devices that [p] switches on, each once, in order of first use: the plan's
    requirement of its vehicle. *)

val reference : t -> Dolphin_geo.Position.t option
(** [reference p] is the place of the first maneuver that has one: allocation prefers vehicles near it. *)

(** {1:path The way that a vehicle goes} *)

(** How deep or high a vehicle is on a leg. The heights of its waypoints are those of [z], altitudes counted from the
    height of the maneuver's location. *)
type level = {
  measured_from : z_unit;  (** the source of the heights; with [Unspecified], they mean nothing *)
  stays_at : float;  (** metres above the ellipsoid, after the last of the waypoints *)
  amplitude : float;  (** metres up and down from there: while it stays, or if it does not, on the way *)
  pitch : float;  (** degrees, with which it goes up and down *)
}

(** One maneuver as a simulated vehicle carries it out. *)
type leg = {
  maneuver : string;  (** its identifier *)
  waypoints : Dolphin_geo.Position.t list;  (** visited in order; [[]] if it is done wherever the vehicle is *)
  level : level;
  dwell : float;  (** seconds at the last of them; [infinity] for a maneuver without end *)
  radius : float;  (** metres around the last of them within which it is done, such as a loiter's circle *)
}

val path : t -> leg list
(** [path p] is a leg for each maneuver of [p], in order: the rows of [Rows] as DUNE runs them, the points of
    [Follow_path], for others the location. Circles are left out. *)

val metres_per_second : maneuver -> default:float -> float
(** [metres_per_second m ~default] is the speed of [m] in metres per second. The speed for revolutions per minute or
    percent of thrust depends on the vehicle: that is [default]. *)

(** {1:plans Plans as values} *)

val compare : t -> t -> int
(** A total order; plans are equal if all that is written in them is. *)

val pp : Format.formatter -> t -> unit
(** The plan's name and its maneuvers' identifiers. *)
