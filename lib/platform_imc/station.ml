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
and begun = { order : Execution.order; memos : Memo.t list }

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
  timers : (float * Residual.timer) list;  (* earliest first *)
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
  heard : Heard.t;
}

type output =
  | Send of { address : Service.address; bytes : string }
  | Announce of string
  | Announce_to of Unix.inet_addr * string
  | Keep of Core.vehicle * Memo.t
  | Note of Core.vehicle * string

let announce_interval = 10.
let eager_announce_interval = 1.
let heartbeat_interval = 1.
let eager_heartbeat_interval = 0.2
let most_nodes = 2000

(* New systems make us announce at once, but not more often than this. *)
let least_announce_interval = 0.25

(* A system that never spoke to us is courted for so long after its first announcement; one that fell silent gets
   heartbeats for so long. *)
let courtship = 15.
let patience = 300.
let most_queries = 50
let longest_name = 200
let telemetry_interval = 0.95

let create settings =
  { settings; nodes = Nodes.empty; ids = Names.empty; bound = Names.empty; telemetry = false; timeouts = Names.empty;
    timeout = 60.; timers = []; told = Names.empty; expected = Names.empty; outbox = Outbox.empty; next_announce = 0.;
    last_announce = neg_infinity; next_heartbeat = 0.; next_eager = infinity; dropped = Names.empty; skipped = 0;
    accepted = 0; heard = Heard.nothing }

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

(* {1 Expected vehicles} *)

let expect name wish s = { s with expected = Names.add name wish s.expected }

(* An order of the console that died, or one that came before the vehicle was heard. *)
let order_of (task : Core.platform_task) : Execution.order =
  { plan = task.name; specification = Option.map Plan_message.of_plan task.plan }

let deadline ~now name s = now +. timeout_of name s

(* What is known to be over, or was never asked for, need not be halted. *)
let halt name begun s =
  match Memo.knowledge ~plan:begun.order.plan begun.memos with
  | None | Some { over = true; _ } -> expect name Nothing s
  | Some _ -> expect name (Halt begun) s

let resume ~now (standing : Dolphin_runtime.Past.standing) s =
  let timeouts = List.fold_left (fun map (v, seconds) -> Names.add v seconds map) s.timeouts standing.timeouts in
  let s = { s with timeouts; timeout = Option.value standing.timeout ~default:s.timeout } in
  let s = List.fold_left (fun s v -> expect v Nothing { s with bound = Names.add v () s.bound }) s standing.bound in
  let begun (errand : Dolphin_runtime.Past.errand) =
    { order = order_of errand.task; memos = List.filter_map Memo.of_json errand.notes }
  in
  (* The end of the errand before may have been noted during this one. *)
  let before (errand : Dolphin_runtime.Past.errand) =
    let is_over = function Memo.Over _ -> true | Asked _ | Taken _ | Runs _ -> false in
    let with_ends b = { b with memos = List.filter is_over (begun errand).memos @ b.memos } in
    Option.map with_ends (Option.map begun errand.before)
  in
  let wish (v, (errand : Dolphin_runtime.Past.errand)) s =
    if errand.is_stopped then halt v (begun errand) s
    else expect v (Run { begun = begun errand; before = before errand; deadline = deadline ~now v s }) s
  in
  let s = List.fold_left (fun s errand -> wish errand s) s standing.errands in
  let by_time (_, due) (_, due') = Float.compare due due' in
  { s with timers = List.map (fun (timer, due) -> (due, timer)) (List.stable_sort by_time standing.timers) }

let adopt ~now ~stopped { order; memos } = command ~now (Adopt { order; stopped; memos })

(* What was wished of [n] is done once it has said what it runs. *)
let receive_expected ~now (n : Node.t) s =
  match Names.find_opt n.name s.expected with
  | Some wish when Execution.is_heard n.execution -> (
      let s = { s with expected = Names.remove n.name s.expected } in
      match wish with
      | Nothing -> (s, [])
      | Halt begun -> adopt ~now ~stopped:true begun n s
      | Run { begun; before = Some before; _ } when begun.memos = [] ->
        let s, sent = adopt ~now ~stopped:true before n s in
        let s, more = command ~now (Start begun.order) (Nodes.find n.id s.nodes) s in
        (s, sent @ more)
      | Run { begun; _ } -> adopt ~now ~stopped:false begun n s)
  | Some _ | None -> (s, [])

let plural seconds = if seconds = 1. then "1 second" else Printf.sprintf "%.0f seconds" seconds

let give_up_expected ~now s =
  let give_up name wish s =
    match wish with
    | Run { begun; deadline; _ } when deadline <= now ->
      let why = Printf.sprintf "no word from the vehicle for %s" (plural (timeout_of name s)) in
      halt name begun (push (Task_failed (name, why)) s)
    | Run _ | Nothing | Halt _ -> s
  in
  Names.fold give_up s.expected s

let expected_due s =
  let earlier _ wish time = match wish with Run { deadline; _ } -> Float.min deadline time | Nothing | Halt _ -> time in
  Names.fold earlier s.expected infinity

let owes_stop s = Names.exists (fun _ wish -> match wish with Halt _ -> true | Nothing | Run _ -> false) s.expected

(* {1 Datagrams} *)

let drop reason s =
  let one = function None -> Some 1 | Some n -> Some (n + 1) in
  ({ s with dropped = Names.update reason one s.dropped }, [])

let skip s = ({ s with skipped = s.skipped + 1 }, [])

(* The messages that somebody here reads. *)
let is_wanted id =
  id = Message.Announce.id || id = Message.Heartbeat.id || id = Message.Estimated_state.id
  || id = Message.Vehicle_state.id || id = Message.Plan_control_state.id || id = Message.Plan_control.id
  || id = Message.Fuel_level.id || id = Message.Log_book_entry.id || id = Message.Entity_list.id || id = Message.Abort.id

let request_of ~id s = (s.settings.first_request + (id * 257)) land 0xFFFF

(* A new system: it is told of us at once. *)
let greet ~now (n : Node.t) s =
  let s = { s with next_eager = Float.min s.next_eager now } in
  let directly =
    if n.hosts = [ Unix.inet_addr_loopback ] then []
    else List.map (fun host -> Announce_to (host, announcement ~now s)) n.hosts
  in
  if now -. s.last_announce < least_announce_interval then
    ({ s with next_announce = Float.min s.next_announce (s.last_announce +. least_announce_interval) }, directly)
  else
    ( { s with last_announce = now; next_announce = now +. eager_announce_interval },
      Announce (announcement ~now s) :: directly )

let rename (before : Node.t option) (n : Node.t) s =
  let ids = match before with Some b when b.name <> n.name -> Names.remove b.name s.ids | Some _ | None -> s.ids in
  { s with ids = Names.add n.name n.id ids }

let is_taken ~now id name s =
  match find name s with
  | Some other -> other.id <> id && now -. Node.last_sign other <= Node.absence
  | None -> false

let announced ~now ~from (p : Packet.t) (a : Message.Announce.t) s =
  if String.length a.sys_name > longest_name then drop "announcement too long" s
  else if is_taken ~now p.src a.sys_name s then drop "name of another" s
  else
    match Nodes.find_opt p.src s.nodes with
    | None when Nodes.cardinal s.nodes >= most_nodes -> drop "too many systems" s
    | None ->
      let n = Node.make ~now ~from ~request:(request_of ~id:p.src s) p a in
      let s = tell ~now n (rename None n (put n { s with accepted = s.accepted + 1 })) in
      if n.address = None then (s, []) else greet ~now n s
    | Some before -> (
        match Node.announce ~now ~from p a before with
        | None -> drop "foreign address" s
        | Some n ->
          let s = tell ~now n (rename (Some before) n (put n { s with accepted = s.accepted + 1 })) in
          if n.address <> before.address && n.address <> None then greet ~now n s else (s, []))

let aborted ~now (p : Packet.t) s =
  let by =
    match Nodes.find_opt p.src s.nodes with Some n -> n.name | None -> Printf.sprintf "system 0x%04x" p.src
  in
  match Nodes.find_opt p.dst s.nodes with
  | Some n -> command ~now (Abort by) n s
  | None -> (s, [])

let heard ~now (p : Packet.t) (n : Node.t) s =
  let first = n.last_heard = neg_infinity in
  let n, outputs = Node.hear ~now ~own:s.settings.id p n in
  let s, sent = carry_out ~now n outputs (put n { s with accepted = s.accepted + 1 }) in
  let s, more = receive_expected ~now n s in
  let sent = sent @ more and n = Nodes.find n.id s.nodes in
  if first && Node.is_vehicle n && not (List.mem_assoc n.name s.settings.payload) then
    let n = Node.queried n in
    let query = Message.Entity_list { Message.Entity_list.default with op = Query } in
    let s = { s with next_eager = Float.min s.next_eager (now +. eager_heartbeat_interval) } in
    (put n s, sent @ to_node ~now n query s)
  else (s, sent)

let packet ~now ~from (p : Packet.t) s =
  match p.content with
  | Message (Announce a) -> announced ~now ~from p a s
  | Message _ | Unknown _ -> (
      match Nodes.find_opt p.src s.nodes with
      | None -> drop "unknown sender" s
      | Some n when not (Node.belongs from n) -> drop "foreign address" s
      | Some n -> (
          match p.content with
          | Message Abort -> aborted ~now p s
          | Message _ | Unknown _ -> heard ~now p n s))

(* Of systems that have announced, from where they are. *)
let listen ~from (h : Header.t) bytes s =
  match Nodes.find_opt h.src s.nodes with
  | Some n when s.settings.listens && Node.belongs from n && Header.check h bytes = Ok () ->
    { s with heard = Heard.add h bytes s.heard }
  | Some _ | None -> s

let datagram ~now ~from ?len bytes s =
  let header = Header.read ?len bytes in
  let s = match header with Ok h -> listen ~from h bytes s | Error _ -> s in
  match header with
  | Error why -> drop (Error.label why) s
  | Ok h when not (is_wanted h.id) -> skip s
  | Ok h when h.src = s.settings.id -> drop "our own" s
  | Ok h when h.id = Message.Plan_control.id && h.dst <> s.settings.id -> skip s
  | Ok _ -> (
      match Packet.decode ?len bytes with
      | Error why -> drop (Error.label why) s
      | Ok p -> packet ~now ~from p s)

(* {1 Time} *)

let is_courted ~now (n : Node.t) =
  Node.is_vehicle n && n.last_heard = neg_infinity && n.address <> None && now -. n.first_announced < courtship

let is_kept ~now (n : Node.t) =
  Node.is_vehicle n && n.address <> None && (now -. Node.last_sign n < patience || not (Execution.idle n.execution))

let heartbeats ~now which s =
  Nodes.fold (fun _ n sent -> if which n then to_node ~now n Heartbeat s @ sent else sent) s.nodes []

(* Entity lists that did not come are asked for again: programs pick vehicles by what they carry. *)
let lacks_entities ~now (n : Node.t) =
  n.entities = None && n.last_heard > neg_infinity && n.queries > 0 && n.queries < most_queries
  && not (Node.silent ~now ~timeout:5. n)

let next_eager ~now s =
  let waits _ n = is_courted ~now n || lacks_entities ~now n in
  if Nodes.exists waits s.nodes then now +. eager_heartbeat_interval else infinity

let beat ~now s =
  let next_eager = next_eager ~now s in
  if now >= s.next_heartbeat then
    ({ s with next_heartbeat = now +. heartbeat_interval; next_eager }, heartbeats ~now (is_kept ~now) s)
  else if now >= s.next_eager then ({ s with next_eager }, heartbeats ~now (is_courted ~now) s)
  else (s, [])

let query ~now s =
  let ask _ (n : Node.t) (s, sent) =
    if not (lacks_entities ~now n) then (s, sent)
    else
      let n = Node.queried n in
      let query = Message.Entity_list { Message.Entity_list.default with op = Query } in
      (put n s, to_node ~now n query s @ sent)
  in
  Nodes.fold ask s.nodes (s, [])

(* A system that does not speak to us may have missed our announcement. *)
let announce ~now s =
  if now < s.next_announce then (s, [])
  else
    let courting = Nodes.exists (fun _ n -> is_courted ~now n) s.nodes in
    let interval = if courting then eager_announce_interval else announce_interval in
    ({ s with next_announce = now +. interval; last_announce = now }, [ Announce (announcement ~now s) ])

let rec expire ~now s =
  match s.timers with
  | (time, timer) :: timers when time <= now -> expire ~now (push (Timer timer) { s with timers })
  | _ :: _ | [] -> s

let was_connected (n : Node.t) s =
  match Names.find_opt n.name s.told with Some told -> told.state.connected | None -> false

(* When the silence of [n] will have lasted too long, if that matters. *)
let end_of_link (n : Node.t) s =
  if was_connected n s || Execution.owes n.execution then n.last_heard +. timeout_of n.name s else infinity

let check ~now _ (n : Node.t) (s, sent) =
  let timeout = timeout_of n.name s in
  let s, more = if Execution.due n.execution <= now then command ~now Tick n s else (s, []) in
  let n = Nodes.find n.id s.nodes in
  let s, lost =
    if not (Execution.owes n.execution && Node.silent ~now ~timeout n) then (s, [])
    else command ~now (Lost (Printf.sprintf "no word from the vehicle for %s" (plural timeout))) n s
  in
  let n = Nodes.find n.id s.nodes in
  let s = if was_connected n s && Node.silent ~now ~timeout n then tell ~now n s else s in
  (s, lost @ more @ sent)

let tick ~now s =
  let s, announced = announce ~now s in
  let beats = now >= Float.min s.next_heartbeat s.next_eager in
  let s, beaten = beat ~now s in
  let s, queried = if beats then query ~now s else (s, []) in
  let s, checked = Nodes.fold (check ~now) s.nodes (s, []) in
  (expire ~now (give_up_expected ~now s), announced @ beaten @ queried @ checked)

let due s =
  let of_node _ (n : Node.t) time =
    Float.min time (Float.min (Execution.due n.execution) (end_of_link n s))
  in
  let timer = match s.timers with (time, _) :: _ -> time | [] -> infinity in
  Float.min s.next_announce (Float.min s.next_heartbeat (Float.min s.next_eager (Float.min timer (expected_due s))))
  |> Nodes.fold of_node s.nodes

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
  match find vehicle s with
  | None | Some _ when Names.mem vehicle s.expected ->
    let before =
      match Names.find vehicle s.expected with
      | Nothing -> None
      | Halt begun -> Some begun
      | Run { begun; before; _ } -> if begun.memos = [] then before else Some begun
    in
    let begun = { order = order_of task; memos = [] } in
    (expect vehicle (Run { begun; before; deadline = deadline ~now vehicle s }) s, [])
  | None -> (push (Task_failed (vehicle, "no such vehicle was heard of")) s, [])
  | Some n -> (
      let order = order_of task in
      match check_order ~now n order s with
      | Ok () -> command ~now (Start order) n s
      | Error why -> (push (Task_failed (vehicle, why)) s, []))

let stop ~now vehicle s =
  let s = { s with outbox = Outbox.without_task vehicle s.outbox } in
  match Names.find_opt vehicle s.expected, find vehicle s with
  | Some (Run { begun; before; _ }), _ ->
    let which = match before with Some before when begun.memos = [] -> before | Some _ | None -> begun in
    (halt vehicle which s, [])
  | Some (Nothing | Halt _), _ | None, None -> (s, [])
  | None, Some n -> command ~now Stop n s

let stop_all ~now s =
  let s = Names.fold (fun vehicle _ s -> fst (stop ~now vehicle s)) s.expected s in
  Nodes.fold
    (fun _ (n : Node.t) (s, sent) ->
       let s, more = stop ~now n.name s in
       (s, more @ sent))
    s.nodes (s, [])

let bind vehicles s = { s with bound = List.fold_left (fun bound v -> Names.add v () bound) s.bound vehicles }
let release vehicles s = { s with bound = List.fold_left (fun bound v -> Names.remove v bound) s.bound vehicles }

let cancel_timer timer s =
  { s with
    timers = List.filter (fun (_, other) -> other <> timer) s.timers;
    outbox = Outbox.without_timer timer s.outbox }

let set_timer ~now timer seconds s =
  let s = cancel_timer timer s in
  let time = now +. seconds in
  let rec insert = function
    | (earlier, _) as other :: rest when earlier <= time -> other :: insert rest
    | rest -> (time, timer) :: rest
  in
  { s with timers = insert s.timers }

let set_connection_timeout vehicles seconds s =
  match vehicles with
  | None -> { s with timeout = seconds; timeouts = Names.empty }
  | Some vs -> { s with timeouts = List.fold_left (fun map v -> Names.add v seconds map) s.timeouts vs }

let telemetry ~now on s =
  let s = { s with telemetry = on } in
  if on then Nodes.fold (fun _ (n : Node.t) s -> if Names.mem n.name s.bound then tell ~now n s else s) s.nodes s else s

(* {1 Events and displays} *)

let take s = Option.map (fun (event, outbox) -> (event, { s with outbox })) (Outbox.take s.outbox)
let waiting s = not (Outbox.is_empty s.outbox)
let quiet s = (not (owes_stop s)) && Nodes.for_all (fun _ (n : Node.t) -> Execution.idle n.execution) s.nodes

type sight = { node : Node.t; state : World.vehicle_state; age : float; linked : bool }

let sights ~now s =
  let sight (n : Node.t) =
    { node = n; state = state_of ~now n s; age = now -. Node.last_sign n;
      linked = not (Node.silent ~now ~timeout:(timeout_of n.name s) n) }
  in
  List.map (fun (_, n) -> sight n) (Nodes.bindings s.nodes)
  |> List.sort (fun a b -> compare (a.node.name, a.node.id) (b.node.name, b.node.id))

let heard id s = Heard.of_system id s.heard
let plan vehicle s = Option.bind (find vehicle s) (fun n -> Execution.progress n.execution)
let dropped s = Names.bindings s.dropped
let skipped s = s.skipped
let accepted s = s.accepted
