open Dolphin_imc
open Dolphin_scenario

type settings = {
  engine : Engine.settings;
  id : int;
  addresses : Address.t list;
  speed : float;
  announce_period : float;
  contact_period : float;
}

(* The messages that are repeated while others listen. *)
type stream = Control | Supervision | Navigation | Life | Fuel | Measurements of string

type t = {
  settings : settings;
  engine : Engine.t;
  peers : Peers.t;
  silences : (float * float) list;              (* by the mission's clock *)
  next_announce : float;
  streams : (stream * float) list;              (* when each is due *)
  stamp : float;                                (* of the latest packet *)
}

type destination = Discovery | Systems of Address.t list
type output = { destination : destination; packet : Packet.t }
type outcome = output list * Activity.t list * t
type channel = Announcements | Data

let vehicle v = v.settings.engine.vehicle
let id v = v.settings.id
let name v = (vehicle v).id
let mission v time = time *. v.settings.speed

(* {1 Streams} *)

let period = function Control -> 0.35 | Supervision -> 0.5 | Navigation -> 0.55 | Life | Fuel | Measurements _ -> 1.

(* A quantity without a message in IMC is not reported. *)
let measurements v =
  let is_told (name, _) = List.mem name Measurement.names in
  List.map (fun (name, _) -> Measurements name) (List.filter is_told (vehicle v).shows)

let all_streams v = [ Supervision; Control; Navigation; Life; Fuel ] @ measurements v

let navigation ~at v =
  let mission_time = mission v at in
  let here = Engine.position ~at:mission_time v.engine in
  let before = Engine.position ~at:(Float.max 0. (mission_time -. 1.)) v.engine in
  let covered = Dolphin_geo.Wgs84.distance before here in
  let is_moving = Engine.is_under_way v.engine && covered > 0. in
  let course = if is_moving then Dolphin_geo.Wgs84.bearing before here else 0. in
  Telemetry.estimated_state ~reference:(vehicle v).position here ~course ~speed:(if is_moving then covered else 0.)

let measured ~at v name =
  let time = mission v at in
  let { Engine.samples; vehicle; _ } = v.settings.engine in
  let readings = Scenario.readings samples vehicle (Engine.position ~at:time v.engine) ~time in
  Option.get (Measurement.to_message name (List.assoc name readings))

let telemetry ~at v : stream -> int * Message.t = function
  | Control -> Engine.entity, Plan_control_state (Engine.plan_control_state ~at:(mission v at) v.engine)
  | Supervision -> Engine.supervisor, Vehicle_state (Engine.vehicle_state v.engine)
  | Navigation -> 52, Estimated_state (navigation ~at v)
  | Life -> 0, Heartbeat
  | Fuel -> 41, Fuel_level (Telemetry.fuel_level (Engine.battery ~at:(mission v at) v.engine))
  | Measurements name -> 53, measured ~at v name

(* {1 Sending} *)

let is_silent ~at v =
  let time = mission v at in
  List.exists (fun (from, until) -> from <= time && time < until) v.silences

let listeners ~at v = Peers.listeners ~at v.peers

(* Time stamps show the order, also of packets at one time. *)
let tick = 1e-5

let stamped ~at v =
  let stamp = Float.max (v.settings.engine.epoch +. at) (v.stamp +. tick) in
  stamp, { v with stamp }

let make ~at ~src_ent ?(dst = Header.nobody) ?(dst_ent = Header.any_entity) content v : Packet.t * t =
  let timestamp, v = stamped ~at v in
  { order = Little_endian; timestamp; src = id v; src_ent; dst; dst_ent; content }, v

let send ~at destination packet v = if is_silent ~at v then [] else [ { destination; packet } ]

let send_to_systems ~at packet v =
  match listeners ~at v with [] -> [] | systems -> send ~at (Systems systems) packet v

let tell ~at ~src_ent ~content v =
  let packet, v = make ~at ~src_ent content v in
  send_to_systems ~at packet v, v

let say ~at v (said : Engine.outgoing) =
  let packet, v =
    make ~at ~src_ent:said.from ~dst:said.to_.system ~dst_ent:said.to_.entity (Message said.message) v
  in
  v, send_to_systems ~at packet v

let say_all ~at v said =
  let v, outputs = List.fold_left_map (say ~at) v said in
  List.concat outputs, v

let after_engine ~at v (said, activities, engine) =
  let outputs, v = say_all ~at { v with engine } said in
  outputs, activities, v

(* {1 What happens by itself} *)

let announce ~at v =
  let { id; addresses; announce_period; _ } = v.settings in
  let position = Engine.position ~at:(mission v at) v.engine in
  let message = Telemetry.announce ~name:(name v) ~kind:(vehicle v).kind ~id position addresses in
  let packet, v = make ~at ~src_ent:76 ~dst:0 (Message (Announce message)) v in
  let next = v.next_announce +. announce_period in
  send ~at Discovery packet v, [], { v with next_announce = (if next > at then next else at +. announce_period) }

(* A new listener gets everything at once. *)
let look ~at v =
  match Peers.look ~at v.peers with
  | None -> [], [], v
  | Some (ids, peers) ->
    let activating id =
      let text = Printf.sprintf "activating transmission to node '%s'" (Peers.name id peers) in
      let entry : Message.Log_book_entry.t =
        { type_ = Info; htime = v.settings.engine.epoch +. at; context = "Transports.UDP"; text }
      in
      { Engine.from = 89; to_ = { system = Header.nobody; entity = Header.any_entity }; message = Log_book_entry entry }
    in
    let told = function
      | Fuel -> (vehicle v).tells_battery
      | Control | Supervision | Navigation | Life | Measurements _ -> true
    in
    let all = List.filter told (all_streams v) in
    let streams = if ids = [] then v.streams else List.map (fun s -> s, at) all in
    let outputs, v = say_all ~at { v with peers; streams } (List.map activating ids) in
    outputs, [], v

let stream ~at v =
  let due, later = List.partition (fun (_, time) -> time <= at) v.streams in
  let tell_one v (s, _) =
    let src_ent, message = telemetry ~at v s in
    let outputs, v = tell ~at ~src_ent ~content:(Message message) v in
    v, outputs
  in
  let v, outputs = List.fold_left_map tell_one v due in
  let again (s, time) =
    let next = time +. period s in
    s, if next > at then next else at +. period s
  in
  List.concat outputs, [], { v with streams = List.map again due @ later }

let engine_due v = Option.map (fun time -> time /. v.settings.speed) (Engine.due v.engine)

(* A time of the mission may change when it is converted to ours and back: an event due by our clock is due. *)
let advance_engine ~at v =
  let time =
    match Engine.due v.engine with
    | Some due when due /. v.settings.speed <= at -> Float.max due (mission v at)
    | Some _ | None -> mission v at
  in
  after_engine ~at v (Engine.advance ~at:time v.engine)

let streams_due v = List.fold_left (fun earliest (_, time) -> Float.min earliest time) infinity v.streams

(* The streams stop without listeners. *)
let stream_if_heard ~at v =
  if streams_due v > at then [], [], v
  else if listeners ~at v = [] then [], [], { v with streams = [] }
  else stream ~at v

let due v =
  let or_never = Option.value ~default:infinity in
  let time =
    Float.min
      (Float.min v.next_announce (streams_due v))
      (Float.min (or_never (engine_due v)) (or_never (Peers.due v.peers)))
  in
  if time = infinity then None else Some time

let both (outputs, activities, v) step =
  let more_outputs, more_activities, v = step v in
  outputs @ more_outputs, activities @ more_activities, v

let advance ~at v =
  let announce_if_due v = if v.next_announce <= at then announce ~at v else [], [], v in
  List.fold_left both ([], [], v) [ advance_engine ~at; announce_if_due; look ~at; stream_if_heard ~at ]

(* {1 What comes in} *)

let relay ~at (p : Packet.t) v =
  match p.content with
  | Message (Heartbeat | Plan_control _) -> send_to_systems ~at p v
  | Message _ | Unknown _ -> []

let is_for (p : Packet.t) v = p.dst = id v || p.dst = Header.broadcast

let obey ~at (p : Packet.t) v =
  let by : Engine.party = { system = p.src; entity = p.src_ent } in
  match p.content with
  | Message (Plan_control c) when is_for p v ->
    after_engine ~at v (Engine.request ~at:(mission v at) ~sent:p.timestamp ~by c v.engine)
  | Message Abort when is_for p v ->
    after_engine ~at v (Engine.abort ~at:(mission v at) ~by ~name:(Peers.name p.src v.peers) v.engine)
  | Message (Entity_list { op = Query; list = _ }) when is_for p v ->
    let list = Telemetry.entities (vehicle v).payload in
    let outputs, v = say_all ~at v [ { from = 0; to_ = by; message = Entity_list { op = Report; list } } ] in
    outputs, [], v
  | Message _ | Unknown _ -> [], [], v

let receive_heard ~at channel ~host (p : Packet.t) v =
  match channel, p.content with
  | Announcements, Message (Announce a) ->
    let addresses = Address.of_services a.services in
    [], [], { v with peers = Peers.announced ~id:p.src ~name:a.sys_name addresses v.peers }
  | Announcements, (Message _ | Unknown _) -> [], [], v
  | Data, _ ->
    let v = { v with peers = Peers.heard ~id:p.src ~host ~at v.peers } in
    let seen = look ~at v in
    both (both seen (fun v -> relay ~at p v, [], v)) (obey ~at p)

let receive ~at channel ~host (p : Packet.t) v =
  let outcome = advance ~at v in
  both outcome (fun v ->
      if is_silent ~at v || p.src = id v then [], [], v else receive_heard ~at channel ~host p v)

(* {1 The beginning} *)

let phase (settings : settings) =
  let { Engine.vehicle; seed; _ } = settings.engine in
  settings.contact_period *. Dolphin_platform_sim.Draw.share ~seed ~vehicle:vehicle.id ~start:(-1) Moment

let create (settings : settings) =
  let silences = Scenario.silences settings.engine.vehicle in
  let joins = match silences with (0., until) :: _ -> until | _ -> 0. in
  { settings; engine = Engine.create settings.engine; silences;
    peers = Peers.empty ~period:settings.contact_period ~phase:(phase settings);
    next_announce = joins /. settings.speed; streams = []; stamp = 0. }

let position ~at v = Engine.position ~at:(mission v at) v.engine
