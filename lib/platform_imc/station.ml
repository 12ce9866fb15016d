open Dolphin_semantics
open Dolphin_imc
open Knowledge

type t = Knowledge.t
type settings = Knowledge.settings
type output = Knowledge.output

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

let create = Knowledge.create
let resume = Expected.resume
let owes_stop = Expected.owes_stop

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
  || id = Message.Abort.id

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
  let s, more = Expected.receive ~now n s in
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
    { s with heard = Received.add h bytes s.heard }
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

let expire ~now s =
  let rung, timers = Timers.rung ~now s.timers in
  List.fold_left (fun s timer -> push (Timer timer) s) { s with timers } rung

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
    else command ~now (Lost (Printf.sprintf "no word from the vehicle for %s" (Expected.plural timeout))) n s
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
  (expire ~now (Expected.give_up ~now s), announced @ beaten @ queried @ checked)

let due s =
  let of_node _ (n : Node.t) time =
    Float.min time (Float.min (Execution.due n.execution) (end_of_link n s))
  in
  let timer = Timers.first s.timers in
  Float.min s.next_announce (Float.min s.next_heartbeat (Float.min s.next_eager (Float.min timer (Expected.due s))))
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
    let begun = { order = Expected.order_of task; memos = [] } in
    (Expected.expect vehicle (Run { begun; before; deadline = Expected.deadline ~now vehicle s }) s, [])
  | None -> (push (Task_failed (vehicle, "no such vehicle was heard of")) s, [])
  | Some n -> (
      let order = Expected.order_of task in
      match check_order ~now n order s with
      | Ok () -> command ~now (Start order) n s
      | Error why -> (push (Task_failed (vehicle, why)) s, []))

let stop ~now vehicle s =
  let s = { s with outbox = Outbox.without_task vehicle s.outbox } in
  match Names.find_opt vehicle s.expected, find vehicle s with
  | Some (Run { begun; before; _ }), _ ->
    let which = match before with Some before when begun.memos = [] -> before | Some _ | None -> begun in
    (Expected.halt vehicle which s, [])
  | Some (Nothing | Halt _), _ | None, None -> (s, [])
  | None, Some n -> command ~now Stop n s

let leaves ~now ~at vehicles s =
  let postpone s vehicle =
    match find vehicle s with Some n -> fst (command ~now (Leaves at) n s) | None -> s
  in
  List.fold_left postpone s vehicles

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
  { s with timers = Timers.cancel timer s.timers; outbox = Outbox.without_timer timer s.outbox }

let set_timer ~now timer seconds s =
  let s = cancel_timer timer s in
  { s with timers = Timers.set timer (now +. seconds) s.timers }

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

let unsettled s =
  let of_node _ (n : Node.t) found =
    match Execution.unsettled n.execution with Some plan -> (n.name, plan) :: found | None -> found
  in
  let of_wish name wish found =
    match wish with Halt { order; _ } -> (name, order.plan) :: found | Nothing | Run _ -> found
  in
  List.sort compare (Nodes.fold of_node s.nodes (Names.fold of_wish s.expected []))

type sight = { node : Node.t; state : World.vehicle_state; age : float; linked : bool }

let sights ~now s =
  let sight (n : Node.t) =
    { node = n; state = state_of ~now n s; age = now -. Node.last_sign n;
      linked = not (Node.silent ~now ~timeout:(timeout_of n.name s) n) }
  in
  List.map (fun (_, n) -> sight n) (Nodes.bindings s.nodes)
  |> List.sort (fun a b -> compare (a.node.name, a.node.id) (b.node.name, b.node.id))

let heard id s = Received.of_system id s.heard
let plan vehicle s = Option.bind (find vehicle s) (fun n -> Execution.progress n.execution)
let dropped s = Names.bindings s.dropped
let skipped s = s.skipped
let accepted s = s.accepted
