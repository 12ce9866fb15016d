type speed_unit = Metres_per_second | Revolutions_per_minute | Percent
type z_unit = Depth | Altitude | Height
type direction = Vehicle_dependent | Clockwise | Counter_clockwise
type payload = { name : string; parameters : (string * string) list }

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
      alternation : float;
      square_curve : bool;
      first_curve_right : bool;
    }
  | Follow_path of (float * float * float) list

type maneuver = {
  id : string;
  kind : kind;
  location : Dolphin_geo.Position.t;
  speed : float * speed_unit;
  z : float * z_unit;
  payloads : payload list;
}

type t = { name : string; description : string; vehicles : string list; maneuvers : maneuver list }

let required_payload p =
  let add names name = if List.mem name names then names else name :: names in
  let of_maneuver names m = List.fold_left (fun names (d : payload) -> add names d.name) names m.payloads in
  List.rev (List.fold_left of_maneuver [] p.maneuvers)

let reference p =
  match p.maneuvers with
  | first :: _ -> first.location
  | [] -> invalid_arg "Plan.reference: a plan without maneuvers"

(* Plans are plain data without functions or cycles. *)
let compare (a : t) (b : t) = Stdlib.compare a b

let pp ppf p =
  Format.fprintf ppf "%s: %a" p.name
    Fmt.(list ~sep:(any ", ") string)
    (List.map (fun (m : maneuver) -> m.id) p.maneuvers)
