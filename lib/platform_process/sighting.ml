open Dolphin_platform_protocol
open Dolphin_semantics

type t = {
  id : Core.vehicle;
  kind : string;
  payload : string list;
  place : (float * float) option;
  height : float;
  depth : float option;
  altitude : float option;
  battery : float option;
  speed : float option;
  readings : (string * float) list;
  link : bool;
  unready : string option;
}

let first (s : Report.sight) =
  match s.kind, s.link with
  | Some kind, Some link ->
    Ok { id = s.vehicle; kind; payload = []; place = None; height = 0.; depth = None; altitude = None;
         battery = None; speed = None; readings = []; link; unready = None }
  | None, _ -> Error (Printf.sprintf "the first report of %s has no type" s.vehicle)
  | Some _, None -> Error (Printf.sprintf "the first report of %s lacks its link" s.vehicle)

let add (s : Report.sight) known =
  let known = match known with Some x -> Ok x | None -> first s in
  let now x before = Option.value x ~default:before in
  let measure readings (name, x) =
    let others = List.remove_assoc name readings in
    match x with Some x -> List.merge Stdlib.compare [ (name, x) ] others | None -> others
  in
  let add x =
    { x with
      readings = List.fold_left measure x.readings s.readings;
      kind = now s.kind x.kind; payload = now s.payload x.payload;
      place = (if s.place = None then x.place else s.place);
      height = now s.height x.height; depth = now s.depth x.depth; altitude = now s.altitude x.altitude;
      battery = now s.battery x.battery; speed = now s.speed x.speed;
      link = now s.link x.link; unready = now s.unready x.unready }
  in
  Result.map add known

let link x = x.link
let without_link x = { x with link = false }
let speed x = x.speed
let battery x = x.battery
let is_placed x = x.place <> None

let describe x : World.vehicle_state =
  let latitude, longitude = Option.value x.place ~default:(0., 0.) in
  { id = x.id; kind = x.kind; payload = x.payload;
    position = { latitude; longitude; height = x.height };
    depth = x.depth;
    altitude = x.altitude;
    battery = x.battery;
    speed = x.speed;
    readings = x.readings;
    connected = x.link;
    unready = (if x.link then x.unready else None); cruise = None; drain = None; progress = [] }

let state x = if is_placed x then Some (describe x) else None
