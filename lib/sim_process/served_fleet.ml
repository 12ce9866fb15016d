open Dolphin_plans
open Dolphin_semantics
open Dolphin_runtime
open Dolphin_scenario
open Dolphin_platform_protocol
module Fleet = Dolphin_platform_sim.Fleet
module Order = Dolphin_platform_protocol.Order
module Names = Map.Make (String)

type t = {
  fleet : Fleet.t;
  scenario : Scenario.t;
  is_remembered : bool;
  said : Report.word option Names.t;  (* by request: the last report on it, if any *)
  running : string Names.t;  (* by vehicle: its request *)
  stopped : string Names.t;  (* by vehicle without a link: the request whose stop is to be confirmed *)
  linked : bool Names.t;  (* as was reported last *)
}

(* Dolphin counts how long links are lost. *)
let for_ever = 1e9

let create ~seed ~is_remembered scenario =
  let fleet = Fleet.create ~seed scenario |> Fleet.set_connection_timeout None for_ever |> Fleet.telemetry Awaited in
  { fleet; scenario; is_remembered; said = Names.empty; running = Names.empty; stopped = Names.empty;
    linked = Names.empty }

let greeting =
  Report.Hello
    { version = Report.version; name = "sim"; adapter = None; plans = [ "name"; "imcPlan"; "mission" ]; announce = 1.;
      patience = 30. }

(* {1 What happens} *)

let sight (s : World.vehicle_state) =
  Report.Vehicle
    { vehicle = s.id; kind = Some s.kind; payload = Some s.payload;
      place = Some (s.position.latitude, s.position.longitude);
      height = Some s.position.height;
      depth = Some s.depth; altitude = Some s.altitude;
      battery = Some s.battery; speed = Some s.speed;
      readings = List.map (fun (name, x) -> (name, Some x)) s.readings; link = Some s.connected;
      unready = Some s.unready }

let say request word f = ({ f with said = Names.add request (Some word) f.said }, [ Report.Request (request, word) ])
let is_linked v f = Option.value (Names.find_opt v f.linked) ~default:false

(* The orders that wait for the link. *)
let link_returned v f =
  match Names.find_opt v f.stopped, Names.find_opt v f.running with
  | Some request, _ -> say request Report.Stopped { f with stopped = Names.remove v f.stopped }
  | None, Some request -> say request Report.Taken f
  | None, None -> (f, [])

let see (state : World.vehicle_state) f =
  let is_new = state.connected && not (is_linked state.id f) in
  let f = { f with linked = Names.add state.id state.connected f.linked } in
  let f, reports = if is_new then link_returned state.id f else (f, []) in
  (f, sight state :: reports)

let ended v word f =
  match Names.find_opt v f.running with
  | None -> (f, [])
  | Some request -> say request word { f with running = Names.remove v f.running }

let event f : Platform.event -> t * Report.t list = function
  | Vehicle state -> see state f
  | Task_done v -> ended v Done f
  | Task_failed (v, why) -> ended v (Failed why) f
  | Timer _ | Input _ | Quiet -> (f, [])

let due f = Fleet.due f.fleet

let advance ~until f =
  let rec go f said =
    match Fleet.due f.fleet with
    | Some time when time <= until -> (
        match Fleet.step f.fleet with
        | None -> (f, said)
        | Some (None, fleet) -> go { f with fleet } said
        | Some (Some e, fleet) ->
          let f, reports = event { f with fleet } e in
          go f (List.rev_append reports said))
    | Some _ | None -> ({ f with fleet = Fleet.advance f.fleet until }, said)
  in
  let f, said = go f [] in
  (f, List.rev said)

(* {1 Orders} *)

let vehicle_of v f = List.find_opt (fun (vehicle : Scenario.vehicle) -> vehicle.id = v) f.scenario.vehicles

let problems_on vehicle plan f =
  match Plan_body.of_json plan with
  | Error why -> [ why ]
  | Ok { plan = None; _ } -> []
  | Ok { plan = Some plan; _ } -> (
      match Option.bind vehicle (fun v -> vehicle_of v f) with
      | None -> []
      | Some vehicle ->
        let carries device =
          List.exists (fun own -> String.lowercase_ascii own = String.lowercase_ascii device) vehicle.payload in
        let lacks = List.filter (fun device -> not (carries device)) (Inline_plan.required_payload plan) in
        let allowed = Inline_plan.vehicles plan in
        let others = if allowed = [] || List.mem vehicle.id allowed then [] else [ vehicle.id ] in
        List.map (Printf.sprintf "no %s on board") lacks
        @ List.map (Printf.sprintf "the plan is not for %s") others)

(* A start that was ordered before is not ordered again. *)
let repeat request f =
  match Names.find_opt request f.said with
  | None -> None
  | Some None -> Some (f, [])
  | Some (Some word) -> Some (f, [ Report.Request (request, word) ])

let start request v plan f =
  match vehicle_of v f, problems_on (Some v) plan f, Plan_body.of_json plan with
  | None, _, _ -> say request (Failed (Printf.sprintf "no vehicle %s here" v)) f
  | Some _, (why :: _), _ | Some _, [], Error why -> say request (Failed why) f
  | Some _, [], Ok task ->
    let fleet = if Names.mem v f.running then Fleet.stop v f.fleet else f.fleet in
    let fleet = Fleet.start v task fleet in
    let f = { f with fleet; running = Names.add v request f.running; said = Names.add request None f.said } in
    if is_linked v f then say request Taken f else (f, [])

let stop request v f =
  match repeat request f with
  | None -> (f, [ Report.Request (request, Stopped) ])
  | Some again when Names.find_opt v f.running <> Some request -> again
  | Some _ ->
    let f = { f with fleet = Fleet.stop v f.fleet; running = Names.remove v f.running } in
    if is_linked v f then say request Stopped f
    else
      ({ f with stopped = Names.add v request f.stopped; said = Names.add request None f.said }, [])

let resume request f =
  match repeat request f with
  | Some again -> again
  | None when f.is_remembered -> (f, [ Report.Request (request, Absent) ])
  | None -> (f, [ Report.Request (request, Unknown "this simulated fleet was restarted without its state") ])

let on_fleet f fleet = ({ f with fleet }, [])

let everyone f = List.map sight (Fleet.vehicles f.fleet)

let carry_out (o : Order.t) f =
  match o with
  | Hello _ | Timeout _ | Kept _ -> (f, [])
  | Refused _ -> (f, everyone f)
  | Telemetry on -> on_fleet f (Fleet.telemetry (if on then Awaited else Off) f.fleet)
  | Hold vs -> on_fleet f (Fleet.bind vs f.fleet)
  | Release vs -> on_fleet f (Fleet.release vs f.fleet)
  | Ping id -> (f, [ Report.Pong id ])
  | Start { request; vehicle; plan; _ } -> (
      match repeat request f with Some again -> again | None -> start request vehicle plan f)
  | Stop { request; vehicle } -> stop request vehicle f
  | Resume { request; _ } -> resume request f
  | Check { id; vehicle; plan } -> (f, [ Report.Checked { id; problems = problems_on vehicle plan f } ])
  | Close ->
    let halt v request (f, said) =
      let f, reports = stop request v f in
      (f, said @ reports)
    in
    let f, said = Names.fold halt f.running (f, []) in
    (f, said @ [ Report.Quiet ])

let changes (o : Order.t) f =
  match o with
  | Start { request; _ } -> not (Names.mem request f.said)
  | Stop { request; vehicle } -> Names.find_opt vehicle f.running = Some request
  | Close -> not (Names.is_empty f.running)
  | Hello _ | Telemetry _ | Hold _ | Release _ | Timeout _ | Ping _ | Resume _ | Check _ | Kept _ | Refused _ -> false

let order ~now o f =
  let f, before = advance ~until:now f in
  let f, said = carry_out o f in
  (f, before @ said)
