open Dolphin_semantics
open Dolphin_runtime
open Dolphin_scenario
module String_map = Map.Make (String)
module String_set = Set.Make (String)
module Int_map = Map.Make (Int)

type occurrence =
  | Link of Core.vehicle                        (* the link comes or goes *)
  | Tell of Core.vehicle                        (* its state is reported *)
  | End of Core.vehicle                         (* its task ends *)
  | Report of Core.vehicle                      (* the end of the task is reported *)
  | Loss of Core.vehicle                        (* the link has been silent for too long *)
  | Expiry of Residual.timer
  | Beat                                        (* telemetry *)
  | Posting of string * Core.value              (* an input is posted *)

(* The work of a vehicle for the program. *)
type activity =
  | Free
  | Ordered of Core.platform_task               (* the order waits for the link *)
  | Under_way of { task : Core.platform_task; outcome : (unit, string) result; ending : Event_queue.key option }
  | Over of { task : Core.platform_task; outcome : (unit, string) result; report : Event_queue.key option }
  (* Ended; the report waits for its turn, or for the link. *)

type silence = { since : float; loss : Event_queue.key }

type craft = {
  body : Vehicle.t;
  connected : bool;
  changes : float list;                         (* when the link comes or goes, from the next time on *)
  activity : activity;
  silence : silence option;                     (* that will be too long for a task or an order *)
  timeout : float option;                       (* of the connection, if it has one of its own *)
  starts : int;                                 (* tasks begun so far *)
  told : World.vehicle_state option;            (* as the program knows it *)
}

type t = {
  seed : int;
  plans : Scenario.plan String_map.t;
  samples : Scenario.sample list;
  fields_still : float;                         (* from then on no field changes *)
  order : Core.vehicle list;                    (* the scenario's vehicles *)
  now : float;
  queue : occurrence Event_queue.t;
  crafts : craft String_map.t;
  bound : String_set.t;
  timers : Event_queue.key Int_map.t;
  timeout : float;
  telemetry : Platform.telemetry;
  beat : Event_queue.key option;
  stopped : String_set.t;                       (* and not reported since *)
}

let default_timeout = 60.
let telemetry_period = 1.

(* {1 Parts} *)

let schedule time occurrence f =
  let key, queue = Event_queue.add time occurrence f.queue in
  key, { f with queue }

let cancel key f = match key with Some key -> { f with queue = Event_queue.remove key f.queue } | None -> f
let put id craft f = { f with crafts = String_map.add id craft f.crafts }

let make_craft (v : Scenario.vehicle) ~connected ~changes =
  { body = Vehicle.make v; connected; changes; activity = Free; silence = None; timeout = None; starts = 0;
    told = None }

(* Vehicles outside of the scenario are never heard. *)
let stranger id =
  let position = Dolphin_geo.Place.apdl in
  make_craft ~connected:false ~changes:[]
    { id; kind = ""; payload = []; position; speed = 1.; battery = 1.; tells_battery = true;
      drain = 0.; charge = 0.; chargers = []; joins = 0.;
      leaves = None; drops = []; batteries = []; shows = []; places = [] }

let find id f = match String_map.find_opt id f.crafts with Some craft -> craft | None -> stranger id

(* The simulated sea, ground and ellipsoid are one. *)
let state f craft : World.vehicle_state =
  let v = Vehicle.scenario craft.body in
  let position = Vehicle.seen_at craft.body ~at:f.now in
  { id = v.id; kind = v.kind; payload = v.payload; position;
    depth = (if position.height < 0. then Some (-.position.height) else None); altitude = None;
    battery = Vehicle.shown_battery craft.body ~at:f.now;
    speed = Some (Vehicle.speed craft.body ~at:f.now);
    readings = Scenario.readings f.samples v (Vehicle.position craft.body ~at:f.now) ~time:f.now;
    connected = craft.connected; unready = None;
    cruise = Some v.speed; drain = Some v.drain; progress = [] }

let not_stopped id f = if String_set.mem id f.stopped then { f with stopped = String_set.remove id f.stopped } else f

(* [tell id f] is the event that makes the state of [id] known, if it is not, and can be. *)
let tell id f =
  let craft = find id f in
  let state = state f craft in
  if craft.told = Some state then None, not_stopped id f
  else Some (Platform.Vehicle state), put id { craft with told = Some state } (not_stopped id f)

(* {1 Telemetry} *)

(* Whether [id] will have a report before long. *)
let is_restless f id =
  let craft = find id f in
  let measures = (Vehicle.scenario craft.body).shows <> [] in
  craft.connected
  && not (Vehicle.is_steady craft.body ~at:f.now && ((not measures) || f.now >= f.fields_still))

(* Beats go on while reports are due, and begin again here when they may be. *)
let wake f =
  if f.telemetry <> Platform.Off && f.beat = None && not (String_set.is_empty f.bound) then
    let key, f = schedule f.now Beat f in
    { f with beat = Some key }
  else f

let beat f =
  let tell_later id f = if (find id f).connected then snd (schedule f.now (Tell id) f) else f in
  let f = String_set.fold tell_later f.bound { f with beat = None } in
  if String_set.exists (is_restless f) f.bound then
    let key, f = schedule (f.now +. telemetry_period) Beat f in
    { f with beat = Some key }
  else f

(* {1 Silent links} *)

let timeout_of (craft : craft) f = Option.value craft.timeout ~default:f.timeout

let set_silence id craft since f =
  let loss, f = schedule (Float.max f.now (since +. timeout_of craft f)) (Loss id) f in
  put id { craft with silence = Some { since; loss } } f

let forget_silence craft f =
  match craft.silence with
  | Some { loss; since = _ } -> { craft with silence = None }, cancel (Some loss) f
  | None -> craft, f

(* After a change of the timeout. *)
let renew_silence id f =
  let craft = find id f in
  match craft.silence with
  | Some { since; loss } -> set_silence id craft since (cancel (Some loss) f)
  | None -> f

(* {1 Tasks} *)

(* [id] sets out to do [task]; an empty battery ends it, if nothing does before. *)
let begin_task id craft task f =
  let v = Vehicle.scenario craft.body in
  let draw = Draw.share ~seed:f.seed ~vehicle:id ~start:craft.starts in
  let plan = String_map.find_opt task.Core.name f.plans in
  let execution = Simulated_execution.make ~draw plan v (Vehicle.position craft.body ~at:f.now) task in
  let body = Vehicle.set_out craft.body ~at:f.now ~charges:execution.charges execution.track in
  let ends = f.now +. execution.duration and empty = Float.max f.now (Vehicle.empty_from body) in
  let time, outcome = if empty < ends then empty, Error "battery empty" else ends, execution.outcome in
  let ending, f =
    if time = infinity then None, f
    else
      let key, f = schedule time (End id) f in
      Some key, f
  in
  let activity = Under_way { task; outcome; ending } in
  wake (put id { craft with body; activity; starts = craft.starts + 1 } f)

(* The vehicle is at rest, and free of its work for the program, on which no report will follow. *)
let give_up craft f =
  let craft, f = forget_silence craft f in
  let f =
    match craft.activity with
    | Under_way { ending = key; _ } | Over { report = key; _ } -> cancel key f
    | Free | Ordered _ -> f
  in
  { craft with activity = Free; body = Vehicle.rest craft.body ~at:f.now }, f

let report_now id craft task outcome f =
  let key, f = schedule f.now (Report id) f in
  put id { craft with activity = Over { task; outcome; report = Some key } } f

let start id task f =
  let craft = find id f in
  match craft.activity with
  | Free when craft.connected -> begin_task id craft task f
  | Free -> set_silence id { craft with activity = Ordered task } f.now f
  | Ordered old | Under_way { task = old; _ } | Over { task = old; _ } ->
    let craft, f = give_up craft f in
    let why = Printf.sprintf "ordered to run '%s' while it ran '%s'" task.Core.name old.Core.name in
    report_now id craft task (Error why) f

let stop id f =
  let craft = find id f in
  match craft.activity with
  | Free -> f
  | Ordered _ | Under_way _ | Over _ ->
    let craft, f = give_up craft f in
    let f = { (put id craft f) with stopped = String_set.add id f.stopped } in
    wake (snd (schedule f.now (Tell id) f))

let look f =
  let one id (states, f) =
    if not (find id f).connected then (states, f)
    else
      match tell id f with
      | Some (Platform.Vehicle state), f -> (state :: states, f)
      | Some (Task_done _ | Task_failed _ | Timer _ | Input _ | Quiet), f | None, f -> (states, f)
  in
  if String_set.is_empty f.stopped then ([], f)
  else
    let states, f = String_set.fold one f.stopped ([], { f with stopped = String_set.empty }) in
    (List.rev states, f)

(* {1 What happens} *)

(* The order waiting for the link goes on. *)
let link_returned id f =
  let craft, f = forget_silence (find id f) f in
  let f = put id craft f in
  match craft.activity with
  | Free | Under_way _ | Over { report = Some _; _ } -> f
  | Ordered task -> begin_task id craft task f
  | Over { task; outcome; report = None } -> report_now id craft task outcome f

let link_dropped id f =
  let craft = find id f in
  match craft.activity with
  | Free | Over { report = Some _; _ } -> f
  | Ordered _ | Under_way _ | Over { report = None; _ } -> set_silence id craft f.now f

let link id f =
  let craft = find id f in
  let changes, f =
    match craft.changes with
    | _ :: (next :: _ as changes) -> changes, snd (schedule next (Link id) f)
    | [] | [ _ ] -> [], f
  in
  let connected = not craft.connected in
  let f = put id { craft with changes; connected } f in
  tell id (wake (if connected then link_returned id f else link_dropped id f))

let ended id f =
  let craft = find id f in
  match craft.activity with
  | Under_way { task; outcome; ending = _ } ->
    let craft = { craft with body = Vehicle.rest craft.body ~at:f.now } in
    if craft.connected then
      let f = report_now id craft task outcome f in
      tell id (wake f)
    else None, put id { craft with activity = Over { task; outcome; report = None } } f
  | Free | Ordered _ | Over _ -> None, f

let report id f =
  let craft = find id f in
  match craft.activity with
  | Over { outcome; _ } ->
    let event = match outcome with Ok () -> Platform.Task_done id | Error why -> Platform.Task_failed (id, why) in
    Some event, put id { craft with activity = Free } f
  | Free | Ordered _ | Under_way _ -> None, f

let lost id f =
  let craft = find id f in
  let why = Printf.sprintf "connection lost for %g s" (timeout_of craft f) in
  let craft, f = give_up craft f in
  Some (Platform.Task_failed (id, why)), put id craft f

let happen f = function
  | Link id -> link id f
  | Tell id -> if (find id f).connected then tell id f else None, f
  | End id -> ended id f
  | Report id -> report id f
  | Loss id -> lost id f
  | Expiry timer -> Some (Platform.Timer timer), { f with timers = Int_map.remove timer f.timers }
  | Beat -> None, beat f
  | Posting (k, x) -> Some (Platform.Input (k, x)), f

(* {1 Time} *)

let now f = f.now

(* Telemetry that is only shown waits for other events: without it, nothing would happen. *)
let first f =
  match Event_queue.first f.queue with
  | Some (_, Beat) when f.telemetry = Platform.Shown && Event_queue.first (Event_queue.rest f.queue) = None -> None
  | first -> first

let due f = Option.map (fun (time, _) -> Float.max f.now time) (first f)

let advance f time =
  let time = match due f with Some due -> Float.min due time | None -> time in
  { f with now = Float.max f.now time }

let step f =
  match first f with
  | None -> None
  | Some (time, occurrence) ->
    let f = { f with now = Float.max f.now time; queue = Event_queue.rest f.queue } in
    Some (happen f occurrence)

(* An entry in the future is there because an event comes of it, at once or in the end. *)
let rec quiet f =
  match first f with
  | None -> true
  | Some (time, _) when time > f.now -> false
  | Some _ -> ( match step f with Some (None, f) -> quiet f | Some (Some _, _) -> false | None -> true)

(* {1 Other commands} *)

let bind ids f = wake { f with bound = List.fold_left (fun bound id -> String_set.add id bound) f.bound ids }
let release ids f = { f with bound = List.fold_left (fun bound id -> String_set.remove id bound) f.bound ids }

let cancel_timer timer f =
  { (cancel (Int_map.find_opt timer f.timers) f) with timers = Int_map.remove timer f.timers }

let set_timer timer seconds f =
  let f = cancel_timer timer f in
  let seconds = if seconds > 0. then seconds else 0. in
  if seconds = infinity then f
  else
    let key, f = schedule (f.now +. seconds) (Expiry timer) f in
    { f with timers = Int_map.add timer key f.timers }

let set_connection_timeout ids seconds f =
  match ids with
  | Some ids ->
    let set f id = renew_silence id (put id { (find id f) with timeout = Some seconds } f) in
    List.fold_left set f ids
  | None ->
    let crafts = String_map.map (fun (craft : craft) -> { craft with timeout = None }) f.crafts in
    String_map.fold (fun id _ f -> renew_silence id f) crafts { f with crafts; timeout = seconds }

let telemetry how f =
  match (how : Platform.telemetry) with
  | Off -> { (cancel f.beat f) with telemetry = Off; beat = None }
  | Shown | Awaited -> wake { f with telemetry = how }

(* {1 The beginning} *)

let create ~seed (s : Scenario.t) =
  let add_plan plans (p : Scenario.plan) = String_map.add p.name p plans in
  let plans = List.fold_left add_plan String_map.empty s.plans in
  let empty =
    { seed; plans; samples = s.samples; fields_still = Scenario.fields_still_from s;
      order = List.map (fun (v : Scenario.vehicle) -> v.id) s.vehicles; now = 0.;
      queue = Event_queue.empty;
      crafts = String_map.empty; bound = String_set.empty; timers = Int_map.empty; timeout = default_timeout;
      telemetry = Off; beat = None; stopped = String_set.empty } in
  let add f (v : Scenario.vehicle) =
    let spans = List.concat_map (fun (from, until) -> [ from; until ]) (Scenario.silences v) in
    let connected, changes = match spans with 0. :: changes -> false, changes | changes -> true, changes in
    let changes = List.filter (fun time -> time < infinity) changes in
    let f = put v.id (make_craft v ~connected ~changes) f in
    let f = if connected then snd (schedule 0. (Tell v.id) f) else f in
    match changes with
    | next :: _ -> snd (schedule next (Link v.id) f)
    | [] -> f
  in
  let post f (i : Scenario.input) =
    let nth f n =
      match i.after with
      | None -> f
      | Some seconds -> snd (schedule (seconds *. float_of_int (n + 1)) (Posting (i.key, Scenario.posted i n)) f)
    in
    List.fold_left nth f (List.init i.times Fun.id)
  in
  List.fold_left post (List.fold_left add empty s.vehicles) s.inputs

(* {1 Displays} *)

let vehicles f =
  let seen id =
    let craft = find id f in
    if craft.connected && craft.told <> None then Some (state f craft) else craft.told in
  List.filter_map seen f.order

let told id f = (find id f).told

let running f id =
  match (find id f).activity with
  | Free -> None
  | Ordered task | Under_way { task; _ } | Over { task; _ } -> Some task.name
