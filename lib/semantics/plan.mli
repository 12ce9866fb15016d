(** Inline plans: what [imcPlan { ... }] describes, ready for any platform that flies maneuvers. *)

type speed_unit = Metres_per_second | Revolutions_per_minute | Percent  (** of full thrust *)

(** What a [z] is measured from: metres below the surface, above the ground, above the ellipsoid. *)
type z_unit = Depth | Altitude | Height

type direction = Vehicle_dependent | Clockwise | Counter_clockwise

(** A device that a maneuver switches on, with its parameters by name. *)
type payload = { name : string; parameters : (string * string) list }

(** What is done; lengths in metres, times in seconds, angles in degrees. *)
type kind =
  | Go_to
  | Loiter of { radius : float; duration : float; direction : direction }
  | Yo_yo of { amplitude : float; pitch : float }
  | Pop_up of { duration : float; current_position : bool; wait_at_surface : bool; station_keep : bool }
  | Station_keeping of { radius : float; duration : float }
  | Compass_calibration of {
      amplitude : float;
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

type maneuver = {
  id : string;  (** ["1.Goto"], ["2.Loiter"]: unique in its plan *)
  kind : kind;
  location : Dolphin_geo.Position.t;  (** where it starts *)
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

val reference : t -> Dolphin_geo.Position.t
(** [reference p] is where the first maneuver is: allocation prefers vehicles near it. *)

val compare : t -> t -> int

val pp : Format.formatter -> t -> unit
(** The plan's name and its maneuvers' identifiers. *)
