open Dolphin_plans
open Dolphin_semantics

(* A vehicle as it was last written, and its reports since. *)
type vehicle = {
  mutable written : World.vehicle_state;
  mutable written_at : float;
  mutable untold : World.vehicle_state option;
}

type t = {
  mutable program : Core.program;
  period : float;
  write : Entry.t -> unit;
  vehicles : (Core.vehicle, vehicle) Hashtbl.t;
  mutable behind : vehicle list;  (* those with something untold, latest first *)
  mutable configuration : Configuration.t;
  mutable transitions : int;
  mutable time : float;
}

let make ?(period = 5.) program header write =
  write (Entry.Header header);
  { program; period; write; vehicles = Hashtbl.create 16; behind = [];
    configuration = Configuration.initial program; transitions = 0; time = 0. }

let resume ?(period = 5.) program replay ~seen write =
  let vehicles = Hashtbl.create 16 in
  let add (written_at, (state : World.vehicle_state)) =
    Hashtbl.replace vehicles state.id { written = state; written_at; untold = None }
  in
  List.iter add seen;
  { program; period; write; vehicles; behind = []; configuration = Replay.configuration replay;
    transitions = Replay.transitions replay; time = Replay.time replay }

(* Metres. A fast vehicle has more samples, or its way could not be drawn. *)
let nearby = 10.

(* Journals never go back in time, whatever clocks do. *)
let pass r time = r.time <- Float.max r.time time

let write r ~time line =
  pass r time;
  r.write (line ~time:r.time)

(* {1 Vehicles} *)

let write_state r vehicle state =
  vehicle.untold <- None;
  vehicle.written <- state;
  vehicle.written_at <- r.time;
  r.write (Vehicle { time = r.time; state })

let catch_up r =
  let behind = List.rev r.behind in
  r.behind <- [];
  List.iter (fun vehicle -> Option.iter (write_state r vehicle) vehicle.untold) behind

let news r ~time (state : World.vehicle_state) =
  pass r time;
  match Hashtbl.find_opt r.vehicles state.id with
  | None ->
    let vehicle = { written = state; written_at = r.time; untold = None } in
    Hashtbl.replace r.vehicles state.id vehicle;
    write_state r vehicle state
  | Some vehicle ->
    let { World.position; depth; altitude; battery; speed; readings; progress; _ } = vehicle.written in
    let is_sample = { state with position; depth; altitude; battery; speed; readings; progress } = vehicle.written in
    let is_near () = Dolphin_geo.Wgs84.distance position state.position < nearby in
    if is_sample && r.time -. vehicle.written_at < r.period && is_near () then begin
      if vehicle.untold = None then r.behind <- vehicle :: r.behind;
      vehicle.untold <- Some state
    end
    else begin
      if vehicle.untold <> None then r.behind <- List.filter (fun other -> other != vehicle) r.behind;
      write_state r vehicle state
    end

(* {1 Transitions} *)

(* Allocation looks where vehicles are, whatever the program's own code reads; and so may an answer, which is code, and
   do fences. *)
let may_depend_on_vehicles r (t : Transition.t) =
  match t.label with
  | Execute | Cannot_execute _ | Answer _ -> true
  | _ ->
    r.program.reads_sensors || not (Fences.is_none r.program.fences)
    || Transition.depends_on_sensors r.program r.configuration

(* Longer ways are written without the points that make no difference of half a metre. *)
let most_points = 1000

let fewer points =
  if List.compare_length_with points most_points <= 0 then points
  else Dolphin_geo.Polyline.simplified ~tolerance:0.5 points

let ways r (t : Transition.t) : (Core.vehicle * Entry.way) list =
  let way v (plan : Inline_plan.t option) : Entry.way option =
    match plan, Hashtbl.find_opt r.vehicles v with
    | None, _ -> Some By_name
    | Some plan, Some { written; untold; _ } ->
      let from = (Option.value untold ~default:written).position in
      let legs = Inline_plan.path ~from ~speed:1. plan in
      Some (Path (fewer (from :: List.concat_map (fun (leg : Inline_plan.leg) -> leg.waypoints) legs)))
    | Some _, None -> None
  in
  let of_effect : Effect.t -> (Core.vehicle * Entry.way) option = function
    | Start (v, { plan; name = _; task_site = _ }) -> Option.map (fun way -> (v, way)) (way v plan)
    | Stop _ | Set_timer _ | Cancel_timer _ | Put_question _ | Withdraw_question _ | Look_for _ | Bind _ | Release _
    | Set_connection_timeout _ | Say _ | Ask _ | Call_host _ | End _ -> None
  in
  List.filter_map of_effect t.effects

let transition ?(unasked = fun () -> false) r ~time ~cause (t : Transition.t) =
  pass r time;
  if r.behind <> [] && may_depend_on_vehicles r t then catch_up r;
  let stuck = t.label = Interrupt && unasked () in
  let event event = r.write (Event { time = r.time; event = Event.of_event ~stuck event }) in
  Option.iter event cause;
  let step = Step.of_transition r.program r.configuration t in
  r.write (Transition { time = r.time; index = r.transitions; step; ways = ways r t });
  r.transitions <- r.transitions + 1;
  r.configuration <- t.next

let replace r ~time program ~line replay =
  pass r time;
  catch_up r;
  r.program <- program;
  r.configuration <- Replay.configuration replay;
  r.write (line ~time:r.time)

let finish r ~time ~stuck =
  pass r time;
  match r.configuration.control with
  | Ended ending ->
    catch_up r;
    let ending : Request.ending = if stuck then { how = "stuck"; message = None } else Request.ending ending in
    r.write (End { time = r.time; transitions = r.transitions; ending })
  | Script _ | Waiting _ | Executing _ -> ()
