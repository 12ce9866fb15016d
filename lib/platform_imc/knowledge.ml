open Dolphin_semantics
open Dolphin_imc
module Nodes = Map.Make (Int)
module Names = Map.Make (String)

type settings = {
  id : int;
  name : string;
  addresses : Service.address list;
  epoch : float;
  first_request : int;
  payload : (Core.vehicle * string list) list;
  types : (Core.vehicle * string) list;
  type_names : (int * string) list;
  listens : bool;
}

(* What is to be done with a vehicle when it is heard of. *)
type wish =
  | Nothing
  | Run of { begun : begun; before : begun option;  (* is to be halted first *) deadline : float }
  | Halt of begun

(* What a console that died was told to have a vehicle do, and what it kept of that; nothing, if it did not ask yet. *)
and begun = { order : Execution.order; memos : Durable_note.t list }

(* What the program was told of a vehicle, and when. *)
type told = { state : World.vehicle_state; at : float }

type t = {
  settings : settings;
  nodes : Node.t Nodes.t;
  ids : int Names.t;
  bound : unit Names.t;
  telemetry : bool;
  timeouts : float Names.t;
  timeout : float;  (* of vehicles that are not in [timeouts] *)
  timers : Timers.t;
  told : told Names.t;
  expected : wish Names.t;  (* vehicles of a console that died *)
  outbox : Outbox.t;
  next_announce : float;
  last_announce : float;
  next_heartbeat : float;
  next_eager : float;
  dropped : int Names.t;
  skipped : int;
  accepted : int;
  heard : Received.t;
}

type output =
  | Send of { address : Service.address; bytes : string }
  | Announce of string
  | Announce_to of Unix.inet_addr * string
  | Keep of Core.vehicle * Durable_note.t
  | Note of Core.vehicle * string

let telemetry_interval = 0.95

let create settings =
  { settings; nodes = Nodes.empty; ids = Names.empty; bound = Names.empty; telemetry = false; timeouts = Names.empty;
    timeout = 60.; timers = Timers.none; told = Names.empty; expected = Names.empty; outbox = Outbox.empty;
    next_announce = 0.; last_announce = neg_infinity; next_heartbeat = 0.; next_eager = infinity;
    dropped = Names.empty; skipped = 0; accepted = 0; heard = Received.nothing }

let timeout_of name s = Option.value (Names.find_opt name s.timeouts) ~default:s.timeout
let find name s = Option.bind (Names.find_opt name s.ids) (fun id -> Nodes.find_opt id s.nodes)
let put (n : Node.t) s = { s with nodes = Nodes.add n.id n s.nodes }

let kind_of (n : Node.t) s =
  match List.assoc_opt n.name s.settings.types with
  | Some kind -> kind
  | None -> Service.kind ~names:s.settings.type_names n.kind

let state_of ~now (n : Node.t) s =
  let payload = List.assoc_opt n.name s.settings.payload in
  Node.state ~now ~timeout:(timeout_of n.name s) ~kind:(kind_of n s) ~payload n

(* {1 Sending} *)

let encode ~now ~dst message s =
  Packet.encode (Packet.make ~src:s.settings.id ~dst ~timestamp:(s.settings.epoch +. now) message)

(* What cannot be encoded was refused when it was ordered. *)
let to_node ~now (n : Node.t) message s =
  match n.address, encode ~now ~dst:n.id message s with
  | Some address, Ok bytes -> [ Send { address; bytes } ]
  | Some _, Error _ | None, _ -> []

let announcement ~now s =
  let message =
    Message.Announce
      { Message.Announce.default with
        sys_name = s.settings.name; sys_type = Ccu; owner = Header.nobody;
        services = Service.announced s.settings.addresses }
  in
  Result.value (encode ~now ~dst:0 message s) ~default:""

(* {1 Telling the program} *)

let push event s = { s with outbox = Outbox.add event s.outbox }

(* What changes at once is told at once; positions and batteries, once a second if the program wants them. *)
let tell ?(urgent = false) ~now (n : Node.t) s =
  if not (Node.is_vehicle n) then s
  else
    let state = state_of ~now n s in
    let news () = push (Vehicle state) { s with told = Names.add n.name { state; at = now } s.told } in
    match Names.find_opt n.name s.told with
    | None -> news ()
    | Some { state = before; at } ->
      if before = state then s
      else if
        before.connected <> state.connected || before.kind <> state.kind || before.payload <> state.payload || urgent
        || (s.telemetry && Names.mem n.name s.bound && now -. at >= telemetry_interval)
      then news ()
      else s

(* What follows from the execution on [n]; [n] is in [s]. *)
let carry_out ~now (n : Node.t) outputs s =
  let carry (s, sent) : Execution.output -> t * output list = function
    | Send message -> (s, List.rev_append (to_node ~now n message s) sent)
    | Done -> (push (Task_done n.name) (tell ~urgent:true ~now n s), sent)
    | Failed why -> (push (Task_failed (n.name, why)) (tell ~urgent:true ~now n s), sent)
    | Keep memo -> (s, Keep (n.name, memo) :: sent)
    | Note text -> (s, Note (n.name, text) :: sent)
  in
  let s, sent = List.fold_left carry (s, []) outputs in
  (tell ~now n s, List.rev sent)

let command ~now input (n : Node.t) s =
  let n, outputs = Node.command ~now input n in
  carry_out ~now n outputs (put n s)
