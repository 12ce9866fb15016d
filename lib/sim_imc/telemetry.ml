open Dolphin_imc
open Dolphin_geo
open Angle

let system_type kind : Message.System_type.t =
  match String.uppercase_ascii kind with
  | "CCU" -> Ccu
  | "HUMANSENSOR" -> Humansensor
  (* IMC has no type for ROVs. *)
  | "UUV" | "AUV" | "ROV" -> Uuv
  | "USV" | "ASV" -> Usv
  | "UAV" -> Uav
  | "UGV" -> Ugv
  | "STATICSENSOR" -> Staticsensor
  | "WSN" -> Wsn
  | _ -> Mobilesensor


let services ~id addresses =
  let of_address (a : Address.t) = [ Address.to_service a ] in
  let version = [ "dune://0.0.0.0/version/dolphin-sim"; "imc+info://0.0.0.0/version/5.4.31" ] in
  String.concat ";"
    ((Printf.sprintf "dune://0.0.0.0/uid/%d" id :: version) @ List.concat_map of_address addresses)

let announce ~name ~kind ~id (p : Position.t) addresses : Message.Announce.t =
  { sys_name = name; sys_type = system_type kind; owner = Header.nobody; lat = radians p.latitude;
    lon = radians p.longitude; height = p.height; services = services ~id addresses }

let estimated_state ~(reference : Position.t) (p : Position.t) ~course ~speed : Message.Estimated_state.t =
  let distance = Wgs84.distance reference p and bearing = radians (Wgs84.bearing reference p) in
  let psi = radians (if course > 180. then course -. 360. else course) in
  { Message.Estimated_state.default with
    lat = radians reference.latitude; lon = radians reference.longitude; height = reference.height;
    x = distance *. cos bearing; y = distance *. sin bearing; z = reference.height -. p.height;
    psi; u = speed; vx = speed *. cos psi; vy = speed *. sin psi;
    depth = Float.max 0. (-.p.height); alt = (if p.height > 0. then p.height else -1.) }

let fuel_level share : Message.Fuel_level.t = { value = 100. *. share; confidence = 100.; opmodes = "" }

(* Devices come after what every vehicle has; the numbers of the latter are those of the messages' entities. *)
let common =
  [ "Daemon", 0; "Heartbeat", 1; "Battery", 41; "Navigation", 52; "Plan Database", 54; "Plan Engine", 55;
    "Supervisor", 75; "Announcement", 76; "UDP", 89 ]

let entities payload =
  let devices = List.mapi (fun i name -> name, 100 + i) payload in
  Tuple_list.to_string (List.map (fun (name, number) -> name, string_of_int number) (common @ devices))
