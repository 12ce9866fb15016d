open Dolphin_imc
open Dolphin_platform_sim
open Dolphin_scenario
module String_map = Map.Make (String)

type settings = {
  vehicle : Scenario.vehicle;
  plans : Scenario.plan list;
  samples : Scenario.sample list;
  seed : int;
  epoch : float;
  strict : bool;
  refuses : string option;
  blocks : (float * float) list;
  losses : float list;
}

type party = { system : int; entity : int }
type outgoing = { from : int; to_ : party; message : Message.t }

type run = {
  plan : string;
  request : int;
  by : party;
  sent : float;
  inline : bool;
  instead : string option;
  flight : Flight.t;
}

type mode =
  | Ready
  | Blocked of { until : float; operation : Message.Vehicle_state.Op_mode.t }
  | Calibrating of { run : run; until : float }
  | Executing of { run : run; since : float; maneuver : Flight.maneuver; ends : float; outcome : (unit, string) result }
  | Lost of { since : float; maneuver : Flight.maneuver; ends : float }  (* the plan; the maneuver goes on *)

type t = {
  settings : settings;
  body : Vehicle.t;
  mode : mode;
  loaded : string;                              (* the last plan that was *)
  statistics : Message.t option;                (* of it *)
  last_outcome : Message.Plan_control_state.Last_outcome.t;
  last_error : (string * float) option;
  blocks : (float * float) list;                (* still to come *)
  losses : float list;                          (* still to come *)
  known : (Specification.t, string) result String_map.t;  (* that came with a START, or why they cannot be flown *)
  stores : int;                                 (* the number that came *)
  starts : int;
}

type outcome = outgoing list * Activity.t list * t

let entity = Log_book.engine
let supervisor = Log_book.supervisor
let calibration = 3.
let recovery = 0.9

(* Of plans that come with requests; a vehicle's database is larger, but has an end too. *)
let most_known = 256

let create (settings : settings) =
  { settings; body = Vehicle.make settings.vehicle; mode = Ready; loaded = ""; statistics = None;
    last_outcome = None; last_error = None; blocks = List.sort compare settings.blocks;
    losses = List.sort compare settings.losses; known = String_map.empty; stores = 0; starts = 0 }

(* {1 State} *)

let position ~at e = Vehicle.position e.body ~at
let battery ~at e = Vehicle.battery e.body ~at
let is_under_way e = match e.mode with Executing _ | Lost _ -> true | Ready | Blocked _ | Calibrating _ -> false
let no_maneuver = 65535

let whole seconds =
  if seconds >= 2147483647. then 2147483647 else if seconds > 0. then int_of_float (Float.round seconds) else 0

let plan_control_state ~at e : Message.Plan_control_state.t =
  let idle state =
    { Message.Plan_control_state.default with
      state; plan_id = e.loaded; plan_progress = -1.; man_type = no_maneuver; last_outcome = e.last_outcome }
  in
  match e.mode with
  | Ready -> idle Ready
  | Blocked _ | Lost _ -> idle Blocked
  | Calibrating _ -> idle Initializing
  | Executing { run; since; maneuver; ends = _; outcome = _ } ->
    let elapsed = at -. since and total = run.flight.execution.duration in
    let known = elapsed > 0. && total > 0. && total < infinity in
    { (idle Executing) with
      plan_id = run.plan; man_id = maneuver.id; man_type = maneuver.kind;
      plan_eta = (if known then whole (total -. elapsed) else 0);
      plan_progress = (if known then Float.min 100. (100. *. elapsed /. total) else -1.);
      man_eta = (if known then whole (maneuver.ends -. elapsed) else 0) }

(* The largest number stands for a time of arrival that is not known. *)
let unknown_time = 65535

let vehicle_state e : Message.Vehicle_state.t =
  let last_error, last_error_time =
    match e.last_error with Some (why, time) -> why, e.settings.epoch +. time | None -> "", -1.
  in
  let at_rest op_mode =
    { Message.Vehicle_state.default with
      op_mode; maneuver_type = no_maneuver; maneuver_stime = -1.; maneuver_eta = unknown_time; last_error;
      last_error_time }
  in
  match e.mode with
  | Ready -> at_rest Service
  | Blocked { operation; until = _ } -> at_rest operation
  | Calibrating _ -> at_rest Calibration
  | Executing { maneuver; since; run = _; ends = _; outcome = _ } | Lost { maneuver; since; ends = _ } ->
    { (at_rest Maneuver) with maneuver_type = maneuver.kind; maneuver_stime = e.settings.epoch +. since }

(* {1 Messages} *)

let all = { system = Header.nobody; entity = Header.any_entity }
let say_control ~at e = { from = entity; to_ = all; message = Plan_control_state (plan_control_state ~at e) }
let say_vehicle e = { from = supervisor; to_ = all; message = Vehicle_state (vehicle_state e) }

let say_done e =
  let state = { (vehicle_state e) with flags = Message.Vehicle_state.Flags.maneuver_done } in
  { from = supervisor; to_ = all; message = Vehicle_state state }

(* The display between a START and its outcome. *)
let say_initializing ~at e =
  let state = plan_control_state ~at e in
  let state = { state with state = Initializing; man_id = ""; man_type = no_maneuver } in
  { from = entity; to_ = all; message = Plan_control_state state }

let reply e ~by ~op ~request ~plan type_ info =
  let reply =
    { Message.Plan_control.default with type_; op; request_id = request; plan_id = plan; arg = e.statistics; info }
  in
  { from = entity; to_ = by; message = Plan_control reply }

let log ~at e line =
  { from = Log_book.entity line; to_ = all; message = Log_book.to_message ~time:(e.settings.epoch +. at) line }

(* [before] has become another state by an event with the rest. *)
let with_mode ~at before (said, activities, e) =
  let mode e = (vehicle_state e).op_mode in
  let changed = if mode e = mode before then [] else [ log ~at e (Log_book.mode (mode e)) ] in
  said @ changed, activities, e

let reply_to_start e (r : run) type_ info = reply e ~by:r.by ~op:Start ~request:r.request ~plan:r.plan type_ info
let requested (r : run) : Activity.request = { plan = r.plan; number = r.request; by = r.by.system; sent = r.sent }

(* {1 Plans begin and end} *)

let running e =
  match e.mode with
  | Executing { run; _ } | Calibrating { run; until = _ } -> Some run
  | Ready | Blocked _ | Lost _ -> None

let rest ~at mode e = { e with mode; body = Vehicle.rest e.body ~at }

let take_off ~at (run : run) e =
  let body = Vehicle.set_out e.body ~at ~charges:run.flight.execution.charges run.flight.execution.track in
  let ends = at +. run.flight.execution.duration and empty = Float.max at (Vehicle.empty_from body) in
  let ends, outcome = if empty < ends then empty, Error "battery empty" else ends, run.flight.execution.outcome in
  let maneuver = Flight.maneuver run.flight 0. in
  let e = { e with body; loaded = run.plan; mode = Executing { run; since = at; maneuver; ends; outcome } } in
  let executing = Printf.sprintf "%s: executing maneuver" maneuver.id in
  ( [ say_vehicle e; say_control ~at e; reply_to_start e run Success executing;
      log ~at e (Log_book.executing ~maneuver:maneuver.id);
      log ~at e (Log_book.answered ~request:`Start ~plan:run.plan executing) ],
    [ Activity.Started { request = requested run; inline = run.inline; instead = run.instead } ],
    e )

let beginning ~at ~initializing ~plan e =
  [ log ~at e (Log_book.start_requested ~plan); initializing; log ~at e (Log_book.initializing ~plan) ]

let refused ~at ~(request : Activity.request) ~by ~instead e why =
  let was_running = running e <> None in
  let initializing = say_initializing ~at e in
  let e = { (rest ~at Ready e) with last_outcome = Failure } in
  let failure = reply e ~by ~op:Start ~request:request.number ~plan:request.plan Failure why in
  let states = say_control ~at e :: (if was_running then [ say_vehicle e ] else []) in
  let answer = Log_book.answered ~error:true ~request:`Start ~plan:request.plan why in
  ( beginning ~at ~initializing ~plan:request.plan e
    @ (failure :: log ~at e answer :: log ~at e (Log_book.refused ~why) :: states),
    [ Activity.Refused { request; why; instead } ], e )

(* [e] is still as before the START. *)
let accepted ~at ~calibrate (run : run) e =
  let initializing = say_initializing ~at e in
  let statistics = Flight.statistics ~name:run.plan run.flight in
  let e = { e with statistics = Some (Message.Plan_statistics statistics); starts = e.starts + 1 } in
  let loaded = reply_to_start e run Success "plan loaded" in
  let before = beginning ~at ~initializing ~plan:run.plan e in
  if calibrate then
    let e = rest ~at (Calibrating { run; until = at +. calibration }) e in
    before @ [ loaded; say_vehicle e ], [], e
  else
    let said, activities, e = take_off ~at run e in
    before @ (loaded :: said), activities, e

(* {1 START} *)

let scenario_plan e name = List.find_opt (fun (p : Scenario.plan) -> p.name = name) e.settings.plans

(* The plan that comes with a START. *)
let brought (c : Message.t Message.Plan_control.t) =
  match c.arg with
  | Some (Plan_specification s) -> Some (Specification.read s)
  | Some (Maneuver m) -> Some (Specification.read (Specification.of_maneuver ~plan:c.plan_id m))
  | Some _ | None -> None

(* It is kept though it cannot be flown. *)
let store ~at ~by name plan e =
  let is_known = String_map.mem name e.known in
  let info = if is_known then "OK (updated)" else "OK (new entry)" in
  let entry : Message.Plan_db_information.t =
    { Message.Plan_db_information.default with
      plan_id = name; change_time = e.settings.epoch +. at; change_sid = by.system }
  in
  let is_room = is_known || String_map.cardinal e.known < most_known in
  let known = if is_room then String_map.add name plan e.known else e.known in
  let e = { e with known; stores = e.stores + 1 } in
  let reply : Message.t =
    Plan_db
      { type_ = Success; op = Set; request_id = e.stores land 0xFFFF; plan_id = name;
        arg = Some (Plan_db_information entry); info }
  in
  let to_ = { system = Header.nobody; entity = Log_book.database } in
  ( [ log ~at e (Log_book.storing ~plan:name); { from = Log_book.database; to_; message = reply };
      log ~at e (Log_book.stored ~plan:name ~info) ],
    e )

(* Its plan, if it is known; [plan] came with the START. *)
let find ~plan e (c : Message.t Message.Plan_control.t) =
  let name = c.plan_id in
  let entry = scenario_plan e name in
  let known = match entry with Some p -> Scenario.knows p e.settings.vehicle | None -> true in
  match e.settings.refuses, plan, c.arg with
  | Some why, _, _ -> Error why
  | None, Some _, _ when not known -> Error "plan is not for this vehicle"
  | None, Some plan, _ -> Result.map Option.some plan
  | None, None, Some _ -> Error "argument is neither a plan nor a maneuver"
  | None, None, None when name = "" -> Error "undefined plan id"
  | None, None, None -> (
      match String_map.find_opt name e.known with
      | Some plan when known -> Result.map Option.some plan
      | Some _ -> Error "undefined plan"
      | None when known && (entry <> None || not e.settings.strict) -> Ok None
      | None -> Error "undefined plan")

let start_found ~at ~by ~(request : Activity.request) ~instead ~inline (c : Message.t Message.Plan_control.t) e =
  function
  | Error why -> refused ~at ~request ~by ~instead e why
  | Ok specification ->
    let name = c.plan_id in
    let draw = Draw.share ~seed:e.settings.seed ~vehicle:e.settings.vehicle.id ~start:e.starts in
    let flight =
      Flight.make ~draw (scenario_plan e name) e.settings.vehicle (position ~at e) ~name specification
    in
    let calibrate = Message.Plan_control.Flags.(mem calibrate c.flags) in
    let run = { plan = name; request = c.request_id; by; sent = request.sent; inline; instead; flight } in
    accepted ~at ~calibrate run e

let start ~at ~by ~(request : Activity.request) (c : Message.t Message.Plan_control.t) e =
  let name = c.plan_id in
  match e.mode with
  | Blocked _ | Lost _ ->
    let why = "vehicle is blocked" in
    [ reply e ~by ~op:Start ~request:c.request_id ~plan:name Failure why ],
    [ Activity.Refused { request; why; instead = None } ], e
  | Ready | Calibrating _ | Executing _ ->
    let instead = Option.map (fun (run : run) -> run.plan) (running e) in
    let plan = brought c in
    let stored, e = match plan with Some plan -> store ~at ~by name plan e | None -> [], e in
    let said, activities, e =
      start_found ~at ~by ~request ~instead ~inline:(plan <> None) c e (find ~plan e c) in
    stored @ said, activities, e

(* {1 STOP, Abort, others} *)

let stop ~at ~by ~request (c : Message.t Message.Plan_control.t) e =
  let plan = c.plan_id in
  let answer type_ info = reply e ~by ~op:Stop ~request:c.request_id ~plan type_ info in
  let asked = log ~at e (Log_book.stop_requested ~plan) in
  let answered ?error info = log ~at e (Log_book.answered ?error ~request:`Stop ~plan info) in
  match running e with
  | None ->
    let why = "no plan is running, request ignored" in
    [ asked; answer Failure why; answered ~error:true why ], [ Activity.Stopped { request; plan = None } ], e
  | Some run ->
    let e = { (rest ~at Ready e) with last_outcome = Failure } in
    [ asked; answer Success "OK"; answered "OK"; say_vehicle e; log ~at e Log_book.stopped; say_control ~at e ],
    [ Activity.Stopped { request; plan = Some run.plan } ], e

let request ~at ~sent ~by (c : Message.t Message.Plan_control.t) e =
  let request : Activity.request = { plan = c.plan_id; number = c.request_id; by = by.system; sent } in
  match c.type_, c.op with
  | Request, Start when c.plan_id = "dislodge" -> [], [ Activity.Ignored { request; why = "plan dislodge" } ], e
  | Request, Start -> with_mode ~at e (start ~at ~by ~request c e)
  | Request, Stop -> with_mode ~at e (stop ~at ~by ~request c e)
  | Request, ((Load | Get | Other _) as op) ->
    let why = "operation is not supported" in
    [ reply e ~by ~op ~request:c.request_id ~plan:c.plan_id Failure why ], [ Activity.Ignored { request; why } ], e
  | (Success | Failure | In_progress | Other _), _ -> [], [], e

(* The plan that is running has failed for [why]; [mode] comes after it. *)
let give_up ~at ~why mode e =
  let run = running e in
  let last_outcome : Message.Plan_control_state.Last_outcome.t =
    match run with Some _ -> Failure | None -> e.last_outcome
  in
  let e = { (rest ~at mode e) with last_outcome; last_error = Some (why, at) } in
  let failure =
    match run with
    | Some run ->
      [ reply_to_start e run Failure why;
        log ~at e (Log_book.answered ~error:true ~request:`Start ~plan:run.plan why) ]
    | None -> []
  in
  failure @ [ say_control ~at e; say_vehicle e ], run, e

let abort ~at ~by ~name e =
  let why = Printf.sprintf "got abort request from system %s - 0x%04X @ 0x%02X" name by.system by.entity in
  let mode =
    match e.mode with
    | Blocked b when b.until > at +. recovery -> Blocked b
    | Ready | Blocked _ | Calibrating _ | Executing _ | Lost _ -> Blocked { until = at +. recovery; operation = Error }
  in
  let said, run, after = give_up ~at ~why mode e in
  let aborted = Activity.Aborted { by = by.system; plan = Option.map (fun (r : run) -> r.plan) run } in
  with_mode ~at e (log ~at e (Log_book.aborted ~why) :: said, [ aborted ], after)

(* {1 What happens by itself} *)

let block_due e = match e.blocks with (from, _) :: _ -> from | [] -> infinity

let loss_due e = match e.losses with at :: _ -> at | [] -> infinity

let mode_due e =
  match e.mode with
  | Ready -> infinity
  | Blocked { until; _ } | Calibrating { until; _ } -> until
  | Executing { run; since; maneuver; ends; _ } when not (Flight.is_last run.flight maneuver) ->
    Float.min (since +. maneuver.ends) ends
  | Executing { ends; _ } | Lost { ends; _ } -> ends

let due e =
  let time = Float.min (loss_due e) (Float.min (block_due e) (mode_due e)) in
  if time = infinity then None else Some time

let block ~at e =
  match e.blocks with
  | [] -> [], [], e
  | (from, lasts) :: blocks ->
    let why = "vehicle is under external control" in
    let said, run, e = give_up ~at ~why (Blocked { until = from +. lasts; operation = External }) { e with blocks } in
    said, [ Activity.Blocked { plan = Option.map (fun (r : run) -> r.plan) run } ], e

(* After a stall the plan engine does not know its plan any more. *)
let lose_plan ~at e =
  let e = { e with losses = (match e.losses with _ :: later -> later | [] -> []) } in
  match e.mode with
  | Executing { run; since; maneuver; ends; outcome = _ } ->
    let ends = Float.min ends (since +. maneuver.ends) in
    let e = { e with mode = Lost { since; maneuver; ends }; last_outcome = Failure } in
    [ say_control ~at e; say_vehicle e ], [ Activity.Lost { request = requested run } ], e
  | Ready | Blocked _ | Calibrating _ | Lost _ -> [], [], e

let ended ~at (run : run) outcome e =
  match outcome with
  | Ok () ->
    let is_done = say_done e in
    let e = { (rest ~at Ready e) with last_outcome = Success } in
    ( [ is_done; reply_to_start e run Success "plan completed"; log ~at e Log_book.completed; say_control ~at e;
        say_vehicle e ],
      [ Activity.Completed (requested run) ], e )
  | Error why ->
    let said, _, e = give_up ~at ~why Ready e in
    said, [ Activity.Failed { request = requested run; why } ], e

let mode_changes ~at e =
  match e.mode with
  | Ready -> [], [], e
  | Blocked _ | Lost _ ->
    let e = { (rest ~at Ready e) with mode = Ready } in
    [ say_vehicle e; log ~at e Log_book.ready; say_control ~at e ], [ Activity.Unblocked ], e
  | Calibrating { run; until = _ } -> take_off ~at run e
  | Executing x when x.ends <= at -> ended ~at x.run x.outcome e
  | Executing x ->
    let is_done = say_done e in
    let maneuver = Flight.maneuver x.run.flight (Float.max x.maneuver.ends (at -. x.since)) in
    let e = { e with mode = Executing { x with maneuver } } in
    [ is_done; say_vehicle e; log ~at e (Log_book.executing ~maneuver:maneuver.id); say_control ~at e ], [], e

let rec advance ~at e =
  match due e with
  | None -> [], [], e
  | Some time when time > at -> [], [], e
  | Some time ->
    let change =
      if loss_due e <= time then lose_plan else if block_due e <= mode_due e then block else mode_changes
    in
    let said, activities, e = with_mode ~at:time e (change ~at:time e) in
    let more_said, more_activities, e = advance ~at e in
    said @ more_said, activities @ more_activities, e
