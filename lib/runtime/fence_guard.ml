open Dolphin_plans
open Dolphin_semantics

type t = {
  fences : Fences.t;
  seen : Fences.sight Vehicle_map.t;
  under_way : run Vehicle_map.t;
}

(* [since]: the limits that it has broken from the start on. *)
and run = { plan : Fences.under_way; since : Fences.beyond }

let make fences = { fences; seen = Vehicle_map.empty; under_way = Vehicle_map.empty }

let watches g = not (Fences.is_none g.fences)

let see (s : World.vehicle_state) g =
  let sight : Fences.sight = { place = s.position; depth = s.depth; altitude = s.altitude } in
  let come_back run =
    match Fences.of_vehicle g.fences ~since:run.since sight with
    | Ok since -> { run with since }
    | Error _ -> run
  in
  let under_way = Vehicle_map.update s.id (Option.map come_back) g.under_way in
  { g with seen = Vehicle_map.add s.id sight g.seen; under_way }

let over v g = { g with under_way = Vehicle_map.remove v g.under_way }
let is_under_way v g = Vehicle_map.mem v g.under_way

(* {1 Starts} *)

let breach g from (task : Core.platform_task) =
  let message (b : Fences.breach) = b.message in
  Option.bind task.plan (fun plan -> Option.map message (Fences.of_plan g.fences ~from plan))

let start v (task : Core.platform_task) g =
  let sight = Vehicle_map.find_opt v g.seen in
  let from = Option.map (fun (s : Fences.sight) -> s.place) sight in
  let parts () = Option.fold task.plan ~none:[] ~some:(Plan_room.make ~from) in
  let u : Fences.under_way =
    { vehicle = v; plan = task.name; parts = (if Fences.least_distance g.fences = None then [] else parts ()) } in
  let others = List.map (fun (_, run) -> run.plan) (Vehicle_map.bindings (Vehicle_map.remove v g.under_way)) in
  let since = Option.fold sight ~none:Fences.nowhere ~some:(Fences.beyond g.fences) in
  match breach g from task with
  | Some why -> Error ("not started: " ^ why)
  | None -> (
      match Fences.beside g.fences u others with
      | Some why -> Error ("not started: " ^ why)
      | None -> Ok { g with under_way = Vehicle_map.add v { plan = u; since } g.under_way })

(* {1 Vehicles} *)

let breaking v g =
  match Vehicle_map.find_opt v g.seen, Vehicle_map.find_opt v g.under_way with
  | Some sight, Some { since; _ } -> (
      match Fences.of_vehicle g.fences ~since sight with
      | Error why -> [ (v, "stopped: " ^ why) ]
      | Ok _ ->
        let place_of w _ = Option.map (fun (s : Fences.sight) -> s.place) (Vehicle_map.find_opt w g.seen) in
        let others = Vehicle_map.bindings (Vehicle_map.filter_map place_of (Vehicle_map.remove v g.under_way)) in
        (* The same whichever of the two was heard of last. *)
        let in_order vs = List.sort (fun (v, _) (w, _) -> String.compare v w) vs in
        let with_v other = Fences.too_near g.fences (in_order [ (v, sight.place); other ]) in
        let add found (v, w, why) =
          let one found v = if List.mem_assoc v found then found else (v, "stopped: " ^ why) :: found in
          one (one found v) w
        in
        in_order (List.fold_left add [] (List.concat_map with_v others)))
  | Some _, None | None, _ -> []

(* {1 Resumption} *)

type past = { guard : t; history : History.t; untold : (Core.vehicle * string) list }

(* [refused] and [stopped] were not reported yet; entries have the latest first. *)
type replayed = {
  g : t;
  refused : (Core.vehicle * string) list;
  stopped : (Core.vehicle * string) list;
  entries : History.entry list;
}

let ask r : Effect.t -> replayed * Effect.t option = function
  | Start (v, task) as asked -> (
      match start v task r.g with
      | Ok g -> ({ r with g }, Some asked)
      | Error why -> ({ r with refused = (v, why) :: r.refused }, None))
  | Stop v as asked ->
    let was_running = is_under_way v r.g in
    ({ r with g = over v r.g; refused = List.remove_assoc v r.refused;
              stopped = List.remove_assoc v r.stopped }, if was_running then Some asked else None)
  | ( Set_timer _ | Cancel_timer _ | Put_question _ | Withdraw_question _ | Look_for _ | Bind _ | Release _
    | Set_connection_timeout _ | Say _ | Ask _ | Call_host _ | End _ ) as asked -> (r, Some asked)

let ask_all r effects =
  let add (r, kept) asked =
    let r, still = ask r asked in
    (r, Option.fold still ~none:kept ~some:(fun asked -> asked :: kept))
  in
  let r, kept = List.fold_left add (r, []) effects in
  (r, List.rev kept)

(* The stops of the guard are of no transition; only starts need the number of theirs. *)
let of_no_start = 0

let entry r (e : History.entry) =
  let keep r what = { r with entries = { e with what } :: r.entries } in
  match e.what with
  | Saw state -> keep { r with g = see state r.g } e.what
  | Asked { number; effects } ->
    let r, effects = ask_all r effects in
    keep r (Asked { number; effects })
  | Happened (Vehicle_failed (v, _)) when List.mem_assoc v r.refused ->
    { r with refused = List.remove_assoc v r.refused }
  | Happened (Vehicle_failed (v, _)) when List.mem_assoc v r.stopped ->
    { r with stopped = List.remove_assoc v r.stopped }
  | Happened (Vehicle_failed (v, why)) when List.mem (v, why) (breaking v r.g) ->
    let all = breaking v r.g in
    let g = List.fold_left (fun g (w, _) -> over w g) r.g all in
    keep { r with g; stopped = List.remove_assoc v all @ r.stopped }
      (Asked { number = of_no_start; effects = List.map (fun (w, _) : Effect.t -> Stop w) all })
  | Happened (Vehicle_failed (v, _) | Vehicle_done v) -> keep { r with g = over v r.g } e.what
  | Noted _
  | Happened
      ( Timer_expired _ | Confirmed _ | Recruited _ | Answered _ | Nobody_answers _ | Replied _ | Host_failed _
      | Input _
      | Interruption ) -> keep r e.what

let replay fences history =
  let { g; refused; stopped; entries } =
    List.fold_left entry { g = make fences; refused = []; stopped = []; entries = [] } history in
  let stop found (v, _) =
    let news = List.filter (fun (w, _) -> not (List.mem_assoc w found)) (breaking v g) in
    found @ news
  in
  let stopped = List.fold_left stop stopped (Vehicle_map.bindings g.under_way) in
  { guard = g; history = List.rev entries; untold = List.rev refused @ stopped }
