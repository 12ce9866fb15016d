open Dolphin_semantics
open Dolphin_runtime
open Dolphin_imc
include Station_state

let datagram = Listening.datagram
let due = Upkeep.due
let most_nodes = Listening.most_nodes
let announce_interval = Presence.announce_interval
let eager_announce_interval = Presence.eager_announce_interval
let heartbeat_interval = Presence.heartbeat_interval
let eager_heartbeat_interval = Presence.eager_heartbeat_interval

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

let start_now ~now vehicle task s =
  match Expected.order_of task, find vehicle s with
  | Error why, _ -> (push (Task_failed (vehicle, why)) s, [])
  | Ok order, (None | Some _) when Expected.mem vehicle s.expected ->
    ({ s with expected = Expected.start ~deadline:(now +. timeout_of vehicle s) vehicle order s.expected }, [])
  | Ok _, None -> (push (Task_failed (vehicle, "no such vehicle was heard of")) s, [])
  | Ok order, Some n -> (
      match check_order ~now n order s with
      | Ok () -> command ~now (Start order) n s
      | Error why -> (push (Task_failed (vehicle, why)) s, []))

let start ~now vehicle task s =
  let s = awake ~now s in
  let s = { s with outbox = Outbox.without_task vehicle s.outbox } in
  if s.twin <> None then (s, [])
  else if now < deferred_until vehicle s && not (Expected.mem vehicle s.expected) then
    ({ s with deferred = Names.add vehicle task s.deferred }, [])
  else
    match taken_by_another vehicle s with
    | Some why -> (push (Task_failed (vehicle, why)) s, [])
    | None -> start_now ~now vehicle task s

(* Tasks that waited for the claims of others. *)
let start_deferred ~now s =
  let due, deferred = Names.partition (fun v _ -> now >= deferred_until v s) s.deferred in
  let one vehicle task (s, sent) =
    let s, more = start ~now vehicle task s in
    (s, sent @ more)
  in
  Names.fold one due ({ s with deferred }, [])

let tick ~now s =
  let s, sent = Upkeep.tick ~now s in
  let s, more = start_deferred ~now s in
  (s, sent @ more)

let stop ~now vehicle s =
  let s = awake ~now s in
  let s = { s with outbox = Outbox.without_task vehicle s.outbox; deferred = Names.remove vehicle s.deferred } in
  match find vehicle s with
  | None | Some _ when Expected.mem vehicle s.expected -> ({ s with expected = Expected.stop vehicle s.expected }, [])
  | None -> (s, [])
  | Some n -> command ~now Stop n s

let bind ~now vehicles s =
  let also v = Option.map (fun why -> Remark (v, "also " ^ why)) (Names.find_opt v s.held) in
  let s = hold vehicles (awake ~now s) in
  let is_rival (n : Node.t) = n.claim <> None in
  let until = now +. contest *. (1. +. s.settings.jitter) in
  let contests =
    if Systems.exists is_rival s.systems then
      List.fold_left (fun contests v -> Names.add v until contests) s.contests vehicles
    else s.contests
  in
  let s = { s with contests } in
  (s, List.filter_map also vehicles @ claims ~now s)

let release ~now vehicles s =
  let s = awake ~now s in
  let without set = List.fold_left (fun set v -> Name_set.remove v set) set vehicles in
  let s = { s with bound = without s.bound; yielded = without s.yielded } in
  (tell_all ~now vehicles s, claims ~now s)

let leaves ~now ~at vehicles s =
  let postpone s vehicle =
    match find vehicle s with Some n -> fst (command ~now (Leaves at) n s) | None -> s
  in
  List.fold_left postpone s vehicles

let stop_all ~now s =
  let s = { s with expected = Expected.stop_all s.expected; deferred = Names.empty } in
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

let waiting s = s.twin = None && not (Outbox.is_empty s.outbox)

let take s =
  if waiting s then Option.map (fun (event, outbox) -> (event, { s with outbox })) (Outbox.take s.outbox) else None

let twin s = s.twin
let commands ~now s =
  let s = awake ~now s in
  (s, s.twin = None && not (listens ~now s))

let resuming s = s.resuming
let owes_stop s = Expected.halts s.expected <> []
let quiet ~now s =
  let is_unsettled (n : Node.t) = not (Execution.is_settled ~now n.execution) in
  s.twin <> None
  || ((not (owes_stop s)) && Names.is_empty s.deferred && not (Systems.exists is_unsettled s.systems))

(* The console that has the run stops them. *)
let unsettled ~now s =
  if s.twin <> None then []
  else
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
