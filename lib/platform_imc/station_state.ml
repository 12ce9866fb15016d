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
  abort_after : float option;
  run : string;
  jitter : float;
}

type t = {
  settings : settings;
  systems : Systems.t;
  bound : Name_set.t;
  seen : float;
  wary_until : float;
  resuming : bool;
  twin : string option;
  contests : float Names.t;
  yielded : Name_set.t;
  warned : Name_set.t;
  crowded : bool;
  deferred : Core.platform_task Names.t;
  claimed : Name_set.t;  (* the last claim to other consoles, each second *)
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

let create settings =
  { settings; systems = Systems.none; bound = Name_set.empty; seen = neg_infinity;
    wary_until = neg_infinity; resuming = false; twin = None; contests = Names.empty; yielded = Name_set.empty;
    warned = Name_set.empty; crowded = false; deferred = Names.empty; claimed = Name_set.empty; held = Names.empty;
    telemetry = false;
    timeouts = Names.empty; timeout = 60.;
    timers = Timers.none; expected = Expected.none; outbox = Outbox.empty; presence = Presence.start;
    dropped = Names.empty; skipped = 0; accepted = 0; received = Received.nothing }

(* Ticks come each second at least. *)
let longest_pause = 2.

(* Claims come each second, and later by a pause that is not noticed as one. *)
let wariness = 3.5
let contest = 0.3
let timeout_of name s = Option.value (Names.find_opt name s.timeouts) ~default:s.timeout
let add_timeouts pairs s = { s with timeouts = List.fold_left (fun map (v, x) -> Names.add v x map) s.timeouts pairs }
let hold vehicles s = { s with bound = List.fold_left (fun bound v -> Name_set.add v bound) s.bound vehicles }
let find name s = Systems.find name s.systems
let update n s = { s with systems = Systems.update n s.systems }

let resume ~now ?(lingering = []) (outstanding : History.outstanding) s =
  let s = { s with timeout = Option.value outstanding.timeout ~default:s.timeout } in
  let s = hold outstanding.bound (add_timeouts outstanding.timeouts s) in
  let s = { s with seen = now; wary_until = now +. wariness; resuming = true } in
  let deadline v = now +. timeout_of v s in
  { s with expected = Expected.resume ~deadline ~lingering outstanding; timers = Timers.of_list outstanding.timers }

let held_by (n : Node.t) = match n.claim with Some (_, claim) -> claim.vehicles | None -> []

let is_of_this_run (n : Node.t) s =
  match n.claim with Some (_, claim) -> claim.run = s.settings.run && claim.run <> "" | None -> false

let with_claims s =
  let add held (n : Node.t) =
    match n.claim with
    | Some (_, claim) when not (is_of_this_run n s) ->
      let why = Claim.obstacle ~console:n.name claim in
      List.fold_left (fun held v -> Names.add v why held) held claim.vehicles
    | Some _ | None -> held
  in
  { s with held = List.fold_left add Names.empty (Systems.to_list s.systems) }

(* {1 Sleep} *)

(* Nothing was heard while this console did not run. *)
let wake ~now s =
  let gap = now -. s.seen in
  let slept s (n : Node.t) = { s with systems = Systems.update (Node.overslept ~now gap n) s.systems } in
  let s = List.fold_left slept s (Systems.to_list s.systems) in
  let yielded = Name_set.filter (fun v -> Names.mem v s.held) s.bound in
  { s with
    wary_until = Float.max s.wary_until (now +. wariness);
    yielded = Name_set.union yielded s.yielded;
    expected = Expected.postpone gap s.expected }

let has_slept ~now s = s.seen > neg_infinity && now -. s.seen > longest_pause

let awake ~now s =
  let s = if has_slept ~now s then wake ~now s else s in
  { s with seen = Float.max s.seen now }

(* Until when a task of [v] must not be started. *)
let deferred_until v s =
  Float.max s.wary_until (Option.value (Names.find_opt v s.contests) ~default:neg_infinity)

let listens ~now s = now < s.wary_until

(* Another console has it, and had it first. *)
let taken_by_another v s = if Name_set.mem v s.yielded then Names.find_opt v s.held else None

let state_of ~now (n : Node.t) s =
  let kind =
    match List.assoc_opt n.name s.settings.types with
    | Some kind -> kind
    | None -> Service.kind ~names:s.settings.type_names n.kind
  in
  let payload = List.assoc_opt n.name s.settings.payload in
  let bound = Name_set.mem n.name s.bound in
  let held =
    match Expected.halting n.name s.expected with
    | _ when bound -> None
    | Some plan -> Some ("may still run plan " ^ plan)
    | None -> Names.find_opt n.name s.held
  in
  Node.state ~now ~timeout:(timeout_of n.name s) ~kind ~payload ~held ~bound n

(* {1 Sending} *)

let encode ~now ~dst message s =
  Packet.encode (Packet.make ~src:s.settings.id ~dst ~timestamp:(s.settings.epoch +. now) message)

(* A plan that cannot be encoded was refused when it was ordered. *)
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

(* A vehicle that may still run a plan of ours is not free for others. *)
let holds ~now s =
  let add held (n : Node.t) = if Execution.unsettled ~now n.execution = None then held else Name_set.add n.name held in
  let halted = Name_set.of_list (List.map fst (Expected.halts s.expected)) in
  if s.twin <> None then Name_set.empty
  else Name_set.diff (List.fold_left add (Name_set.union s.bound halted) (Systems.to_list s.systems)) s.yielded

let claims ~now s =
  let vehicles = Name_set.elements (holds ~now s) in
  let { program; run; _ } = s.settings in
  let claim = Claim.to_message { program; run; resuming = listens ~now s; vehicles } in
  let to_console n = if is_console n then to_node ~now n claim s else [] in
  List.concat_map to_console (Systems.to_list s.systems)

(* {1 Telling the program} *)

let push event s = { s with outbox = Outbox.add event s.outbox }

let tell ?(urgent = false) ~now (n : Node.t) s =
  if not (Node.is_vehicle n) then s
  else
    let state = state_of ~now n s in
    let periodic : Outbox.periodic =
      if Name_set.mem n.name s.bound then if s.telemetry then Everything else Nothing
      (* A pick depends on its place, and so does the allocation of its tasks. *)
      else if World.is_ready state then Moves
      else Nothing
    in
    { s with outbox = Outbox.vehicle ~now ~urgent ~periodic state s.outbox }

let gone (n : Node.t) s =
  match Outbox.told n.name s.outbox with
  | None -> s
  | Some state ->
    let s = if state.connected then push (Vehicle { state with connected = false; unready = None }) s else s in
    { s with outbox = Outbox.forget n.name s.outbox }

let tell_all ~now names s =
  List.fold_left (fun s name -> match find name s with Some n -> tell ~now n s | None -> s) s names

(* {1 Executions} *)

let may_command ~now (n : Node.t) s =
  s.twin = None && (not (has_slept ~now s || listens ~now s)) && taken_by_another n.name s = None

let is_start : Execution.output -> bool = function
  | Send (Plan_control { op = Start; type_ = Request; _ }) -> true
  | Send _ | Keep _ | Done | Failed _ | Remark _ -> false

let rec carry_out ~now (n : Node.t) outputs s =
  let may_command = may_command ~now n s in
  let carry (s, sent) : Execution.output -> t * output list = function
    | Send message -> (s, if may_command then List.rev_append (to_node ~now n message s) sent else sent)
    | Done -> (push (Task_done n.name) (tell ~urgent:true ~now n s), sent)
    | Failed why -> (push (Task_failed (n.name, why)) (tell ~urgent:true ~now n s), sent)
    | Keep note -> (s, Keep (n.name, note) :: sent)
    | Remark text -> (s, Remark (n.name, text) :: sent)
  in
  let s, sent = List.fold_left carry (s, []) outputs in
  let s = tell ~now n s in
  match taken_by_another n.name s with
  | Some why when List.exists is_start outputs ->
    let s, more = command ~now (Execution.Lost why) n s in
    (s, List.rev_append sent more)
  | Some _ | None -> (s, List.rev sent)

and command ~now (input : Execution.input) (n : Node.t) s =
  let n, outputs = Node.command ~now input n in
  carry_out ~now n outputs (update n s)

let again (n : Node.t) s = Option.value (Systems.find_id n.id s.systems) ~default:n

let command_all ~now inputs n s =
  let one (s, sent) input =
    let s, more = command ~now input (again n s) s in
    (s, sent @ more)
  in
  List.fold_left one (s, []) inputs

let for_each f s =
  let one (s, sent) n =
    let s, more = f (again n s) s in
    (s, more @ sent)
  in
  List.fold_left one (s, []) (Systems.to_list s.systems)
