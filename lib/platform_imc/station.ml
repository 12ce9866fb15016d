open Dolphin_semantics
open Dolphin_runtime
open Dolphin_imc
module Names = Map.Make (String)
module Name_set = Set.Make (String)

type settings = {
  id : int;
  name : string;
  program : string;
  addresses : Service.address list;
  epoch : float;
  first_request : int;
  payload : (Core.vehicle * string list) list;
  types : (Core.vehicle * string) list;
  type_names : (int * string) list;
  records : bool;
}

type t = {
  settings : settings;
  systems : Systems.t;
  bound : Name_set.t;
  held : string Names.t;  (* by other consoles, and by which, in words *)
  telemetry : bool;
  timeouts : float Names.t;
  timeout : float;  (* of vehicles that are not in [timeouts] *)
  timers : Timers.t;
  expected : Expected.t;
  outbox : Outbox.t;
  presence : Presence.t;
  dropped : int Names.t;
  skipped : int;
  accepted : int;
  received : Received.t;
}

type output =
  | Send of { address : Service.address; bytes : string }
  | Announce of string
  | Announce_to of Unix.inet_addr * string
  | Keep of Core.vehicle * Durable_note.t
  | Remark of Core.vehicle * string

let announce_interval = Presence.announce_interval
let eager_announce_interval = Presence.eager_announce_interval
let heartbeat_interval = Presence.heartbeat_interval
let eager_heartbeat_interval = Presence.eager_heartbeat_interval
let most_nodes = 2000

(* So long after its first announcement a vehicle that never spoke to us gets eager heartbeats; so long after its last
   sign of life one that fell silent gets heartbeats. *)
let contact_patience = 15.
let silence_patience = 300.
let most_queries = 50
let longest_name = 200

let create settings =
  { settings; systems = Systems.none; bound = Name_set.empty; held = Names.empty; telemetry = false;
    timeouts = Names.empty; timeout = 60.;
    timers = Timers.none; expected = Expected.none; outbox = Outbox.empty; presence = Presence.start;
    dropped = Names.empty; skipped = 0; accepted = 0; received = Received.nothing }

let timeout_of name s = Option.value (Names.find_opt name s.timeouts) ~default:s.timeout
let add_timeouts pairs s = { s with timeouts = List.fold_left (fun map (v, x) -> Names.add v x map) s.timeouts pairs }
let hold vehicles s = { s with bound = List.fold_left (fun bound v -> Name_set.add v bound) s.bound vehicles }
let find name s = Systems.find name s.systems
let update n s = { s with systems = Systems.update n s.systems }

let resume ~now (outstanding : History.outstanding) s =
  let s = { s with timeout = Option.value outstanding.timeout ~default:s.timeout } in
  let s = hold outstanding.bound (add_timeouts outstanding.timeouts s) in
  let deadline v = now +. timeout_of v s in
  { s with expected = Expected.resume ~deadline outstanding; timers = Timers.of_list outstanding.timers }

(* After a change of what other consoles hold. *)
let with_claims s =
  let add held (n : Node.t) =
    match n.claim with
    | Some (_, claim) ->
      let why = Claim.obstacle ~console:n.name claim in
      List.fold_left (fun held v -> Names.add v why held) held claim.vehicles
    | None -> held
  in
  { s with held = List.fold_left add Names.empty (Systems.to_list s.systems) }

let state_of ~now (n : Node.t) s =
  let kind =
    match List.assoc_opt n.name s.settings.types with
    | Some kind -> kind
    | None -> Service.kind ~names:s.settings.type_names n.kind
  in
  let payload = List.assoc_opt n.name s.settings.payload in
  let held = if Name_set.mem n.name s.bound then None else Names.find_opt n.name s.held in
  Node.state ~now ~timeout:(timeout_of n.name s) ~kind ~payload ~held n

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

let query ~now (n : Node.t) s =
  let n = Node.queried n in
  let query = Message.Entity_list { Message.Entity_list.default with op = Query } in
  (update n s, to_node ~now n query s)

let is_console (n : Node.t) = n.kind = Ccu && n.address <> None

(* To all other consoles. *)
let claims ~now s =
  let claim = Claim.to_message { program = s.settings.program; vehicles = Name_set.elements s.bound } in
  let to_console n = if is_console n then to_node ~now n claim s else [] in
  List.concat_map to_console (Systems.to_list s.systems)

(* {1 Telling the program} *)

let push event s = { s with outbox = Outbox.add event s.outbox }

let tell ?(urgent = false) ~now (n : Node.t) s =
  if not (Node.is_vehicle n) then s
  else
    let periodic = s.telemetry && Name_set.mem n.name s.bound in
    { s with outbox = Outbox.vehicle ~now ~urgent ~periodic (state_of ~now n s) s.outbox }

(* What follows from the execution on [n]; [n] is in [s]. *)
let carry_out ~now (n : Node.t) outputs s =
  let carry (s, sent) : Execution.output -> t * output list = function
    | Send message -> (s, List.rev_append (to_node ~now n message s) sent)
    | Done -> (push (Task_done n.name) (tell ~urgent:true ~now n s), sent)
    | Failed why -> (push (Task_failed (n.name, why)) (tell ~urgent:true ~now n s), sent)
    | Keep note -> (s, Keep (n.name, note) :: sent)
    | Remark text -> (s, Remark (n.name, text) :: sent)
  in
  let s, sent = List.fold_left carry (s, []) outputs in
  (tell ~now n s, List.rev sent)

(* [command ~now input n s] gives [input] to the execution on [n]. *)
let command ~now input (n : Node.t) s =
  let n, outputs = Node.command ~now input n in
  carry_out ~now n outputs (update n s)

(* [n] as it is in [s]. *)
let again (n : Node.t) s = Option.value (Systems.find_id n.id s.systems) ~default:n

(* One input after another. *)
let command_all ~now inputs n s =
  let one (s, sent) input =
    let s, more = command ~now input (again n s) s in
    (s, sent @ more)
  in
  List.fold_left one (s, []) inputs

(* {1 Datagrams} *)

let drop reason s =
  let one = function None -> Some 1 | Some n -> Some (n + 1) in
  ({ s with dropped = Names.update reason one s.dropped }, [])

let skip s = ({ s with skipped = s.skipped + 1 }, [])

(* The messages that somebody here reads. *)
let is_wanted id =
  id = Message.Announce.id || id = Message.Heartbeat.id || id = Message.Estimated_state.id
  || id = Message.Vehicle_state.id || id = Message.Plan_control_state.id || id = Message.Plan_control.id
  || id = Message.Fuel_level.id || id = Message.Log_book_entry.id || id = Message.Entity_list.id
  || id = Message.Abort.id || id = Message.Entity_parameters.id

let request_of ~id s = (s.settings.first_request + (id * 257)) land 0xFFFF

(* A new system: it is told of us at once. *)
let introduce ~now (n : Node.t) s =
  let directly =
    if n.hosts = [ Unix.inet_addr_loopback ] then []
    else List.map (fun host -> Announce_to (host, announcement ~now s)) n.hosts
  in
  let presence, is_due = Presence.met ~now s.presence in
  ({ s with presence }, if is_due then Announce (announcement ~now s) :: directly else directly)

(* A system with several links, which is heard from each of them in turn, is where it was. *)
let is_elsewhere ~(before : Node.t) (n : Node.t) =
  match before.address, n.address with
  | _, None -> false
  | None, Some _ -> true
  | Some was, Some address -> address.port <> was.port || not (Node.belongs address.host before)

let announced ~now ~from (p : Packet.t) (a : Message.Announce.t) s =
  let accept n s =
    tell ~now n { s with systems = Systems.announced n s.systems; accepted = s.accepted + 1 }
  in
  if String.length a.sys_name > longest_name then drop "announcement too long" s
  else if Systems.is_taken ~now ~id:p.src a.sys_name s.systems then drop "name of another" s
  else
    match Systems.find_id p.src s.systems with
    | None when Systems.cardinal s.systems >= most_nodes -> drop "too many systems" s
    | None ->
      let n = Node.make ~now ~from ~request:(request_of ~id:p.src s) p a in
      if n.address = None then (accept n s, []) else introduce ~now n (accept n s)
    | Some before -> (
        match Node.announce ~now ~from p a before with
        | None -> drop "foreign address" s
        | Some n ->
          if is_elsewhere ~before n then introduce ~now n (accept n s) else (accept n s, []))

let name_of id s =
  match Systems.find_id id s.systems with Some n -> n.name | None -> Printf.sprintf "system 0x%04x" id

let aborted ~now (p : Packet.t) s =
  match Systems.find_id p.dst s.systems with
  | Some n -> command ~now (Abort (name_of p.src s)) n s
  | None -> (s, [])

(* What was intended for an expected vehicle is done once it has said what it runs. *)
let take_over ~now (n : Node.t) s =
  if Execution.report n.execution = None then (s, [])
  else
    let inputs, expected = Expected.heard n.name s.expected in
    command_all ~now inputs n { s with expected }

(* What it is said to carry, and does not list. *)
let missing_devices (before : Node.t) (n : Node.t) s =
  match before.entities, n.entities, List.assoc_opt n.name s.settings.payload with
  | None, Some listed, Some claimed ->
    let listed = List.map String.lowercase_ascii listed in
    List.filter (fun device -> not (List.mem (String.lowercase_ascii device) listed)) claimed
  | _, _, _ -> []

let remark_on_payload before n s =
  match missing_devices before n s with
  | [] -> []
  | devices ->
    [ Remark (n.name, Printf.sprintf "does not list %s among its entities, as --imc-payload has it"
                (String.concat ", " devices)) ]

let heard ~now (p : Packet.t) (n : Node.t) s =
  let before = n in
  let first = n.last_heard = neg_infinity in
  let n, outputs = Node.hear ~now ~own:s.settings.id p n in
  let s, sent = carry_out ~now n outputs (update n { s with accepted = s.accepted + 1 }) in
  let s, more = take_over ~now n s in
  let n = again n s in
  let sent = remark_on_payload before n s @ sent in
  if first && Node.is_vehicle n then
    let at = now +. Presence.eager_heartbeat_interval in
    let s, queried = query ~now n { s with presence = Presence.hasten ~at s.presence } in
    (s, sent @ more @ queried)
  else (s, sent @ more)

(* Vehicles send on to all consoles what one of them requests. *)
let request_of_another ~now (vehicle : Node.t) (p : Packet.t) s =
  match p.content with
  | Message (Plan_control { type_ = Request; op = Stop; _ }) ->
    command ~now (Stopped_by (name_of p.src s)) vehicle { s with accepted = s.accepted + 1 }
  | Message _ | Unknown _ -> skip s

let tell_all ~now names s =
  List.fold_left (fun s name -> match find name s with Some n -> tell ~now n s | None -> s) s names

let held_by (n : Node.t) = match n.claim with Some (_, claim) -> claim.vehicles | None -> []

(* What two consoles hold at once was picked by both at the same time. *)
let claimed ~now (before : Node.t) s =
  let n = again before s in
  let held = held_by n and held_before = held_by before in
  if held = held_before then (s, [])
  else
    let conflict v =
      match n.claim with
      | Some (_, claim) when Name_set.mem v s.bound && not (List.mem v held_before) ->
        Some (Remark (v, "also " ^ Claim.obstacle ~console:n.name claim))
      | Some _ | None -> None
    in
    (tell_all ~now (held @ held_before) (with_claims s), List.filter_map conflict held)

let packet ~now ~from (p : Packet.t) s =
  match p.content with
  | Message (Announce a) -> announced ~now ~from p a s
  | Message _ | Unknown _ -> (
      match Systems.find_id p.src s.systems with
      | None -> drop "unknown sender" s
      | Some n when not (Node.belongs from n) -> drop "foreign address" s
      | Some n -> (
          match p.content with
          | Message Abort -> aborted ~now p s
          | Message (Entity_parameters _) ->
            let s, sent = heard ~now p n s in
            let s, more = claimed ~now n s in
            (s, sent @ more)
          | Message _ | Unknown _ -> heard ~now p n s))

(* Of systems that have announced, from where they are. *)
let record ~from (h : Header.t) bytes s =
  match Systems.find_id h.src s.systems with
  | Some n when s.settings.records && Node.belongs from n && Header.check h bytes = Ok () ->
    { s with received = Received.add h bytes s.received }
  | Some _ | None -> s

let datagram ~now ~from ?len bytes s =
  let header = Header.read ?len bytes in
  let s = match header with Ok h -> record ~from h bytes s | Error _ -> s in
  let decoded f =
    match Packet.decode ?len bytes with
    | Error why -> drop (Error.label why) s
    | Ok p -> f p
  in
  match header with
  | Error why -> drop (Error.label why) s
  | Ok h when not (is_wanted h.id) -> skip s
  | Ok h when h.src = s.settings.id -> drop "our own" s
  | Ok h when h.id = Message.Plan_control.id && h.dst <> s.settings.id -> (
      match Systems.find_id h.dst s.systems with
      | Some vehicle when h.src <> h.dst && Node.belongs from vehicle ->
        decoded (fun p -> request_of_another ~now vehicle p s)
      | Some _ | None -> skip s)
  | Ok _ -> decoded (fun p -> packet ~now ~from p s)

(* {1 Time} *)

(* It has announced itself and not spoken to us: it may have missed our announcement. *)
let is_awaited ~now (n : Node.t) =
  Node.is_vehicle n && n.last_heard = neg_infinity && n.address <> None && now -. n.first_announced < contact_patience

let is_kept ~now (n : Node.t) =
  Node.is_vehicle n && n.address <> None
  && (now -. Node.last_sign n < silence_patience || not (Execution.idle n.execution))

(* Entity lists that did not come are asked for again: programs pick vehicles by what they carry. *)
let lacks_entities ~now (n : Node.t) =
  n.entities = None && n.last_heard > neg_infinity && n.queries > 0 && n.queries < most_queries
  && not (Node.silent ~now ~timeout:5. n)

(* [(s, [])] with [f] carried out for each system in turn. *)
let for_each f s =
  let one (s, sent) n =
    let s, more = f (again n s) s in
    (s, more @ sent)
  in
  List.fold_left one (s, []) (Systems.to_list s.systems)

let beat ~now s =
  let awaited = Systems.exists (fun n -> is_awaited ~now n || lacks_entities ~now n) s.systems in
  let presence, heartbeats = Presence.beat ~now ~awaited s.presence in
  let is_due =
    match heartbeats with
    | All -> is_kept ~now
    | Awaited -> is_awaited ~now
    | Nobody -> fun _ -> false
  in
  let s, beaten =
    for_each (fun n s -> (s, if is_due n then to_node ~now n Heartbeat s else [])) { s with presence }
  in
  if heartbeats = Nobody then (s, [])
  else
    let s, queried = for_each (fun n s -> if lacks_entities ~now n then query ~now n s else (s, [])) s in
    let claims = if heartbeats = All && not (Name_set.is_empty s.bound) then claims ~now s else [] in
    (s, claims @ beaten @ queried)

let announce ~now s =
  let presence, is_due = Presence.announce ~now ~awaited:(Systems.exists (is_awaited ~now) s.systems) s.presence in
  ({ s with presence }, if is_due then [ Announce (announcement ~now s) ] else [])

let expire ~now s =
  let expired, timers = Timers.expired ~now s.timers in
  List.fold_left (fun s timer -> push (Timer timer) s) { s with timers } expired

let was_connected (n : Node.t) s =
  match Outbox.told n.name s.outbox with Some state -> state.connected | None -> false

let seconds x = if x = 1. then "1 second" else Printf.sprintf "%.0f seconds" x
let no_word name s = Printf.sprintf "no word from the vehicle for %s" (seconds (timeout_of name s))

(* When the silence of [n] will have lasted too long, if that matters. *)
let end_of_link (n : Node.t) s =
  if was_connected n s || Execution.owes n.execution then n.last_heard +. timeout_of n.name s else infinity

(* When what is known of [n] becomes old: that it was busy, and what it holds. *)
let turns (n : Node.t) =
  let rested = Option.fold n.freed ~none:infinity ~some:(fun at -> at +. Node.rest) in
  let unclaimed = Option.fold n.claim ~none:infinity ~some:(fun (at, _) -> at +. Claim.patience) in
  (rested, unclaimed)

let turn ~now (n : Node.t) s =
  let rested, unclaimed = turns n in
  let s = if now >= rested then tell ~now (Node.rested n) (update (Node.rested n) s) else s in
  if now < unclaimed then s else tell_all ~now (held_by n) (with_claims (update (Node.unclaimed (again n s)) s))

let check ~now (n : Node.t) s =
  let s = turn ~now n s in
  let n = again n s in
  let timeout = timeout_of n.name s in
  let s, more = if Execution.due n.execution <= now then command ~now Tick n s else (s, []) in
  let n = again n s in
  let s, lost =
    if not (Execution.owes n.execution && Node.silent ~now ~timeout n) then (s, [])
    else command ~now (Lost (no_word n.name s)) n s
  in
  let n = again n s in
  let s = if was_connected n s && Node.silent ~now ~timeout n then tell ~now n s else s in
  (s, lost @ more)

let give_up ~now s =
  let late, expected = Expected.give_up ~now s.expected in
  let fail s v = push (Task_failed (v, no_word v s)) s in
  List.fold_left fail { s with expected } late

let tick ~now s =
  let s, announced = announce ~now s in
  let s, beaten = beat ~now s in
  let s, checked = for_each (check ~now) s in
  (expire ~now (give_up ~now s), announced @ beaten @ checked)

let due s =
  let of_node time (n : Node.t) = Float.min time (Float.min (Execution.due n.execution) (end_of_link n s)) in
  let of_node time n =
    let rested, unclaimed = turns n in
    Float.min (of_node time n) (Float.min rested unclaimed)
  in
  let own = Float.min (Presence.due s.presence) (Float.min (Timers.first s.timers) (Expected.due s.expected)) in
  List.fold_left of_node own (Systems.to_list s.systems)

(* {1 Commands} *)

(* Larger ones do not fit a datagram. *)
let largest = 65507

let check_order ~now (n : Node.t) (order : Execution.order) s =
  let arg = Option.map (fun p -> Message.Plan_specification p) order.specification in
  let message = Message.Plan_control { Message.Plan_control.default with plan_id = order.plan; arg } in
  match n.address, encode ~now ~dst:n.id message s with
  | None, _ -> Error "the vehicle announces no address for IMC over UDP"
  | Some _, Error why -> Error (Format.asprintf "the plan cannot be sent: %a" Error.pp_encode why)
  | Some _, Ok bytes when String.length bytes > largest ->
    Error (Printf.sprintf "the plan cannot be sent: %d bytes do not fit a datagram" (String.length bytes))
  | Some _, Ok _ -> Ok ()

let start ~now vehicle task s =
  let s = { s with outbox = Outbox.without_task vehicle s.outbox } in
  match Expected.order_of task, find vehicle s with
  | Error why, _ -> (push (Task_failed (vehicle, why)) s, [])
  | Ok order, (None | Some _) when Expected.mem vehicle s.expected ->
    ({ s with expected = Expected.start ~deadline:(now +. timeout_of vehicle s) vehicle order s.expected }, [])
  | Ok _, None -> (push (Task_failed (vehicle, "no such vehicle was heard of")) s, [])
  | Ok order, Some n -> (
      match check_order ~now n order s with
      | Ok () -> command ~now (Start order) n s
      | Error why -> (push (Task_failed (vehicle, why)) s, []))

let stop ~now vehicle s =
  let s = { s with outbox = Outbox.without_task vehicle s.outbox } in
  match find vehicle s with
  | None | Some _ when Expected.mem vehicle s.expected -> ({ s with expected = Expected.stop vehicle s.expected }, [])
  | None -> (s, [])
  | Some n -> command ~now Stop n s

let bind ~now vehicles s =
  let also v = Option.map (fun why -> Remark (v, "also " ^ why)) (Names.find_opt v s.held) in
  let s = hold vehicles s in
  (s, List.filter_map also vehicles @ claims ~now s)

let release ~now vehicles s =
  let s = { s with bound = List.fold_left (fun bound v -> Name_set.remove v bound) s.bound vehicles } in
  (tell_all ~now vehicles s, claims ~now s)

let leaves ~now ~at vehicles s =
  let postpone s vehicle =
    match find vehicle s with Some n -> fst (command ~now (Leaves at) n s) | None -> s
  in
  List.fold_left postpone s vehicles

let stop_all ~now s =
  let s = { s with expected = Expected.stop_all s.expected } in
  for_each (fun n s -> stop ~now n.name s) s

let cancel_timer timer s =
  { s with timers = Timers.cancel timer s.timers; outbox = Outbox.without_timer timer s.outbox }

let set_timer ~now timer seconds s =
  let s = cancel_timer timer s in
  { s with timers = Timers.set timer (now +. seconds) s.timers }

let set_connection_timeout vehicles seconds s =
  match vehicles with
  | None -> { s with timeout = seconds; timeouts = Names.empty }
  | Some vs -> add_timeouts (List.map (fun v -> (v, seconds)) vs) s

let telemetry ~now on s =
  let s = { s with telemetry = on } in
  let tell s (n : Node.t) = if Name_set.mem n.name s.bound then tell ~now n s else s in
  if on then List.fold_left tell s (Systems.to_list s.systems) else s

(* {1 Events and displays} *)

let take s = Option.map (fun (event, outbox) -> (event, { s with outbox })) (Outbox.take s.outbox)
let waiting s = not (Outbox.is_empty s.outbox)
let owes_stop s = Expected.halts s.expected <> []
let quiet ~now s =
  (not (owes_stop s)) && not (Systems.exists (fun n -> not (Execution.is_settled ~now n.execution)) s.systems)

let unsettled ~now s =
  let of_node (n : Node.t) = Option.map (fun plan -> (n.name, plan)) (Execution.unsettled ~now n.execution) in
  List.sort compare (List.filter_map of_node (Systems.to_list s.systems) @ Expected.halts s.expected)

type system = { node : Node.t; state : World.vehicle_state; age : float; linked : bool }

let systems ~now s =
  let system (n : Node.t) =
    { node = n; state = state_of ~now n s; age = now -. Node.last_sign n;
      linked = not (Node.silent ~now ~timeout:(timeout_of n.name s) n) }
  in
  let by_name a b = compare (a.node.name, a.node.id) (b.node.name, b.node.id) in
  List.sort by_name (List.map system (Systems.to_list s.systems))

let received id s = Received.of_system id s.received
let plan vehicle s = Option.bind (find vehicle s) (fun n -> Execution.progress n.execution)
let dropped s = Names.bindings s.dropped
let skipped s = s.skipped
let accepted s = s.accepted
