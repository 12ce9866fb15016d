open Dolphin_semantics
open Dolphin_imc
open Dolphin_geo.Angle
module Position = Dolphin_geo.Position

type t = {
  id : int;
  name : string;
  kind : Message.System_type.t;
  hosts : Unix.inet_addr list;
  address : Service.address option;
  clock : Vehicle_clock.t;
  execution : Execution.t;
  first_announced : float;
  last_announced : float;
  last_heard : float;
  position : (float * Position.t) option;
  located : float option;
  depth : float option;
  altitude : float option;
  announced_position : Position.t option;
  mode : (float * Message.Vehicle_state.Op_mode.t) option;
  error : string;
  battery : (float * float) option;
  speed : (float * float) option;
  readings : (string * (float * float)) list;
  entities : string list option;
  queries : int;
  freed : float option;
  claim : (float * Claim.t) option;
  moved : (Service.address * float) option;
  shared : float option;
}

let absence = 30.
let rest = 1.
let currency = 2.
let belongs host n = List.mem host n.hosts
let is_vehicle n = Service.is_vehicle n.kind
let last_sign n = Float.max n.last_announced n.last_heard

(* {1 Discovery} *)

let placed ~lat ~lon ~height =
  Result.to_option
    (Position.make ~latitude:(degrees lat) ~longitude:(degrees lon) ~height)

(* The address of the system: 0.0.0.0 stands for the sender of the announcement. *)
let addresses ~from services =
  let real (a : Service.address) = if a.host = Unix.inet_addr_any then { a with host = from } else a in
  List.map real (Service.addresses services)

let choose ~from ~current (addresses : Service.address list) =
  let kept = List.find_opt (fun a -> Some a = current) addresses in
  let direct = List.find_opt (fun (a : Service.address) -> a.host = from) addresses in
  match kept, direct, addresses with
  | Some a, _, _ when a.host = from -> Some a
  | _, Some a, _ | Some a, None, _ -> Some a
  | None, None, first :: _ -> Some first
  | None, None, [] -> None

(* The content of an announcement about [n]. *)
let described ~now ~from (p : Packet.t) (a : Message.Announce.t) n =
  let addresses = addresses ~from a.services in
  let clock, _ = Vehicle_clock.observe ~now ~sent:p.timestamp n.clock in
  { n with
    kind = a.sys_type;
    hosts = List.sort_uniq compare (from :: List.map (fun (a : Service.address) -> a.host) addresses);
    address = choose ~from ~current:n.address addresses;
    clock; last_announced = now;
    (* Systems that do not know where they are announce zeros. *)
    announced_position = (if a.lat = 0. && a.lon = 0. then None else placed ~lat:a.lat ~lon:a.lon ~height:a.height) }

let most_hosts = 32
let named id name = if String.trim name = "" then Printf.sprintf "imc-%04x" id else name

let make ~now ~from ?abort_after ~request (p : Packet.t) (a : Message.Announce.t) =
  described ~now ~from p a
    { id = p.src; name = named p.src a.sys_name; kind = a.sys_type; hosts = []; address = None;
      clock = Vehicle_clock.unknown; execution = Execution.create ?abort_after ~request (); first_announced = now;
      last_announced = now; last_heard = neg_infinity; position = None; located = None; depth = None; altitude = None;
      announced_position = None; mode = None;
      error = ""; battery = None; speed = None; readings = []; entities = None;
      queries = 0; freed = None; claim = None; moved = None; shared = None }

let whereabouts = function
  | Some address -> Format.asprintf "%a" Service.pp_address address
  | None -> "an unknown address"

let place n = Printf.sprintf "%s at %s" n.name (whereabouts n.address)

type warning = { about : string; text : string }
type announcement = Own of t * warning option | Other of t * warning option

(* [other] has the IMC address of [n], and speaks from [host]. *)
let rival ~now ~host other n =
  let text = Printf.sprintf "two systems have the IMC address 0x%04x: %s, and %s" n.id (place n) other in
  let warning text = Some { about = other; text } in
  if belongs host n then
    ({ n with shared = Some now }, warning (text ^ "; their messages cannot be told apart, so it cannot be picked"))
  else (n, warning (text ^ ", which is ignored"))

(* A system that was restarted moves to another port; two with one IMC address seem to move there and back. *)
let stay_or_move ~now ~from ~before n =
  match before.address, n.address, before.moved with
  | Some was, Some is, Some (earlier, at) when was <> is && is = earlier && now -. at <= absence ->
    let n = { n with address = Some was; moved = Some (earlier, now) } in
    let other = Printf.sprintf "%s at %s" n.name (whereabouts (Some is)) in
    rival ~now ~host:from other n
  | Some was, Some is, _ when was.port <> is.port && now -. before.last_announced <= absence ->
    ({ n with moved = Some (was, before.last_announced) }, None)
  | _, _, _ -> (n, None)

let announce ~now ~from ~may_rename (p : Packet.t) (a : Message.Announce.t) n =
  let name = named p.src a.sys_name and addresses = addresses ~from a.services in
  let is_there = belongs from n && n.address <> None && List.exists (fun x -> Some x = n.address) addresses in
  let same = (belongs from n && name = n.name) || (is_there && may_rename) in
  if same || now -. last_sign n > absence then begin
    let hosts = n.hosts in
    let described = described ~now ~from p a { n with name } in
    (* Systems with several links announce on each of them, perhaps with that link's address only. *)
    let all = List.sort_uniq compare (hosts @ described.hosts) in
    let described = if same && List.length all <= most_hosts then { described with hosts = all } else described in
    let n, warning = stay_or_move ~now ~from ~before:n described in
    Own (n, warning)
  end
  else
    let other = Printf.sprintf "%s at %s" name (whereabouts (choose ~from ~current:None addresses)) in
    let n, warning = rival ~now ~host:from other n in
    Other (n, warning)

(* {1 Its reports} *)

(* No vehicle is farther from its reference point; the ground is not flat. *)
let farthest = 1e7

let position_of (s : Message.Estimated_state.t) =
  let near x = Float.is_finite x && Float.abs x <= farthest in
  if not (near s.x && near s.y && near s.z) then None
  else
    Option.map
      (fun reference -> Dolphin_geo.Wgs84.displace reference ~north:s.x ~east:s.y)
      (placed ~lat:s.lat ~lon:s.lon ~height:(s.height -. s.z))

let newer sent = function
  | Some (before, _) -> sent > before
  | None -> true

let estimated ~now ~sent state n =
  match position_of state with
  | Some position when newer sent n.position ->
    let speed = Float.hypot state.vx state.vy in
    let speed = if Float.is_finite speed then Some (sent, speed) else n.speed in
    let told x = if 0. <= x && x <= Position.highest then Some x else None in
    let depth, altitude =
      match n.kind with
      | Uuv | Usv -> (told state.depth, None)
      | Uav | Ugv | Other _ | Ccu | Humansensor | Staticsensor | Mobilesensor | Wsn -> (None, told state.alt)
    in
    { n with position = Some (sent, position); located = Some now; depth; altitude; speed }
  | Some _ | None -> n

let fuel ~sent (level : Message.Fuel_level.t) n =
  if Float.is_finite level.value && newer sent n.battery then
    { n with battery = Some (sent, Float.max 0. (Float.min 1. (level.value /. 100.))) }
  else n

(* Several sensors may report one quantity; the last report counts. *)
let measured ~sent name value n =
  if Float.is_finite value && newer sent (List.assoc_opt name n.readings) then
    let others = List.remove_assoc name n.readings in
    { n with readings = List.merge (fun (a, _) (b, _) -> String.compare a b) [ (name, (sent, value)) ] others }
  else n

let vehicle ~sent (state : Message.Vehicle_state.t) n =
  if newer sent n.mode then { n with mode = Some (sent, state.op_mode); error = state.last_error } else n

let entities (list : Message.Entity_list.t) n =
  match list.op with
  | Report -> { n with entities = Some (List.map fst (Tuple_list.of_string list.list)) }
  | Query | Reload | Other _ -> n

let command ~now input n =
  let execution, outputs = Execution.step ~now ~clock:n.clock input n.execution in
  ({ n with execution }, outputs)

(* Without the plan that ran before, the outcome of a plan could not be known later. *)
let obstacle n = Readiness.obstacle ~mode:n.mode ~error:n.error (Execution.report n.execution)

let is_resting ~now n = match n.freed with Some at -> now < at +. rest | None -> false

(* [n] that was [before], as to whether it has just become free: of a plan that was not ours. *)
let freed ~now ~jitter before n =
  let is_idle n = Execution.idle n.execution in
  match obstacle before, obstacle n with
  | Some _, None when is_idle before && is_idle n && Execution.report before.execution <> None ->
    { n with freed = Some (now +. jitter) }
  | _, Some _ -> { n with freed = None }
  | (Some _ | None), None -> n

let let_go ~now ~jitter n = if jitter > 0. then { n with freed = Some (now +. jitter -. rest) } else n
let overslept ~now gap n = { n with last_heard = Float.min now (n.last_heard +. gap) }
let unlocated n = { n with located = None }
let unshared n = { n with shared = None }
let rested n = { n with freed = None }
let unclaimed n = { n with claim = None }

let claimed ~now parameters n =
  match Claim.of_message parameters with
  | Some claim -> { n with claim = Some (now, claim) }
  | None -> n

let hear_message ~now ~own (p : Packet.t) n =
  let clock, sent = Vehicle_clock.observe ~now ~sent:p.timestamp n.clock in
  let n = { n with clock; last_heard = now } in
  match p.content with
  | Message (Estimated_state state) -> (estimated ~now ~sent state n, [])
  | Message (Fuel_level level) -> (fuel ~sent level n, [])
  | Message (Entity_list list) -> (entities list n, [])
  | Message (Vehicle_state state) -> command ~now (Vehicle { sent; state }) (vehicle ~sent state n)
  | Message (Plan_control_state state) -> command ~now (State { sent; state }) n
  | Message (Entity_parameters parameters) -> (claimed ~now parameters n, [])
  | Message (Log_book_entry entry) -> command ~now (Log { sent; entry }) n
  | Message (Plan_control reply) when p.dst = own -> command ~now (Reply { sent; reply }) n
  | Message message -> (
      match Measurement.of_message message with
      | Some (name, value) -> (measured ~sent name value n, [])
      | None -> (n, []))
  | Unknown _ -> (n, [])

(* Reported once: it may come with each datagram. *)
let remark_on_stamp (p : Packet.t) before n : Execution.output list =
  if Vehicle_clock.strays before.clock = 0 && Vehicle_clock.strays n.clock > 0 then
    [ Remark
        (Printf.sprintf "a datagram has the time stamp %.12g, which is far from the vehicle's clock: it is not used"
           p.timestamp) ]
  else []

let hear ~now ?(jitter = 0.) ~own p n =
  let heard, outputs = hear_message ~now ~own p n in
  (freed ~now ~jitter n heard, remark_on_stamp p n heard @ outputs)

let queried n = { n with queries = n.queries + 1 }

(* {1 As programs see it} *)

let silent ~now ~timeout n = now -. n.last_heard >= timeout
let unknown_position = { Position.latitude = 0.; longitude = 0.; height = 0. }

(* Between two plans of another program a vehicle is ready for a millisecond. *)
let unready ~now ~held ~bound n =
  match Execution.unsettled ~now n.execution, held, obstacle n with
  | Some plan, _, _ when not (Execution.idle n.execution) -> Some ("may still run plan " ^ plan)
  | _, _, _ when n.shared <> None -> Some (Printf.sprintf "shares its IMC address 0x%04x with another system" n.id)
  | _, Some why, _ | _, None, Some why -> Some why
  | _, None, None when is_resting ~now n -> Some "was busy a moment ago"
  | _, None, None when bound || Option.fold n.located ~none:false ~some:(fun at -> now < at +. currency) -> None
  | _, None, None ->
    Some
      (if n.position = None then "has not reported its position yet"
       else Printf.sprintf "has not reported its position for %.0f s" currency)

let state ~now ~timeout ~kind ~payload ~held ~bound n : World.vehicle_state =
  let position =
    match n.position, n.announced_position with
    | Some (_, p), _ | None, Some p -> p
    | None, None -> unknown_position
  in
  let connected = is_vehicle n && not (silent ~now ~timeout n) in
  let is_free = Execution.idle n.execution || not (bound || Execution.owes n.execution) in
  { id = n.name;
    kind;
    payload = (match payload with Some devices -> devices | None -> Option.value n.entities ~default:[]);
    position;
    depth = n.depth;
    altitude = n.altitude;
    battery = Option.map snd n.battery;
    speed = Option.map snd n.speed;
    readings = List.map (fun (name, (_, value)) -> (name, value)) n.readings;
    connected;
    unready = (if connected && is_free then unready ~now ~held ~bound n else None);
    cruise = None; drain = None; progress = [] }

let mode ~names n =
  match n.mode with
  | Some (_, mode) ->
    let number = Message.Vehicle_state.Op_mode.to_int mode in
    Option.value (List.assoc_opt number names) ~default:(Message.Vehicle_state.Op_mode.name mode)
  | None -> "-"
