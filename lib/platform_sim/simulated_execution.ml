open Dolphin_plans
open Dolphin_semantics
open Dolphin_scenario

type t = { track : Track.t; duration : float; outcome : (unit, string) result; charges : float option }

let default_duration : Scenario.duration = { least = 60.; most = 180. }
let refuse position why = { track = Track.stay position; duration = 0.; outcome = Error why; charges = None }

let drawn_duration draw (plan : Scenario.plan option) =
  let { Scenario.least; most } = Option.value (Option.bind plan (fun p -> p.duration)) ~default:default_duration in
  Draw.between least most (draw Draw.Length)

let by_name draw (plan : Scenario.plan option) (vehicle : Scenario.vehicle) position =
  let drawn = drawn_duration draw plan in
  match plan with
  | Some { place = Some place; duration; _ } ->
    let needed = 2. *. Dolphin_geo.Wgs84.distance position place /. vehicle.speed in
    let duration = if duration = None then Float.max drawn needed else drawn in
    Track.there_and_back position place ~speed:vehicle.speed ~duration, duration
  | Some { place = None; _ } | None ->
    Track.circuit position ~bearing:(360. *. draw Course) ~speed:vehicle.speed ~duration:drawn, drawn

(* The vertical goal of a vehicle for a height of [unit]; [None]: it stays as high as it is. The depth of the sea is
   unknown. *)
let reached kind (unit : Plan.z_unit) =
  match String.uppercase_ascii kind, unit with
  | _, Unspecified -> None
  | ("UUV" | "AUV" | "ROV"), (Depth | Height) -> Some (Float.min 0.)
  | ("UUV" | "AUV" | "ROV"), Altitude -> None
  | "UAV", (Height | Altitude) -> Some (Float.max 0.)
  | "UAV", Depth -> None
  | ("USV" | "ASV" | "UGV"), (Depth | Height | Altitude) -> None
  | _, (Depth | Height | Altitude) -> Some Fun.id

(* Metres per second. *)
let climb kind = if String.uppercase_ascii kind = "UAV" then 3. else 0.5

let leg kind ({ waypoints; level; dwell; speed; _ } : Inline_plan.leg) : Track.leg =
  match reached kind level.measured_from with
  | None -> { waypoints; vertical = Level; dwell; speed }
  | Some height ->
    let at (p : Dolphin_geo.Position.t) = Dolphin_geo.Position.at_height (height p.height) p in
    let swing =
      if level.amplitude = 0. then None
      else
        let low = height (level.stays_at -. level.amplitude) and high = height (level.stays_at +. level.amplitude) in
        Some { Track.low; high; slope = speed *. Float.abs (sin (Dolphin_geo.Angle.radians level.pitch)) }
    in
    let vertical = Track.Reaching { rate = climb kind; stays_at = height level.stays_at; swing } in
    { waypoints = List.rev (List.rev_map at waypoints); vertical; dwell; speed }

let inline plan (vehicle : Scenario.vehicle) position =
  let path = Inline_plan.path ~from:position ~speed:vehicle.speed plan in
  let track = Track.through position (List.rev (List.rev_map (leg vehicle.kind) path)) in
  track, Track.duration track

let fails draw (plan : Scenario.plan option) =
  match plan with
  | None | Some { ending = Succeeds; _ } -> false
  | Some { ending = Fails; _ } -> true
  | Some { ending = May_fail share; _ } -> draw Draw.Failure < share

let make ~draw plan (vehicle : Scenario.vehicle) position (task : Core.platform_task) =
  let known = match plan with Some p -> Scenario.knows p vehicle | None -> true in
  let allowed =
    match Option.map Inline_plan.vehicles task.plan with
    | Some (_ :: _ as vehicles) -> List.mem vehicle.id vehicles
    | Some [] | None -> true
  in
  if not known then refuse position (Printf.sprintf "unknown plan '%s'" task.name)
  else if not allowed then refuse position (Printf.sprintf "plan '%s' is not for this vehicle" task.name)
  else
    let track, duration =
      match task.plan with
      | Some p -> inline p vehicle position
      | None -> by_name draw plan vehicle position
    in
    let charges = Option.bind plan (fun (p : Scenario.plan) -> p.charges) in
    if fails draw plan then
      let duration = if duration < infinity then duration else drawn_duration draw plan in
      { track; duration = draw Moment *. duration; outcome = Error "plan failed"; charges }
    else { track; duration; outcome = Ok (); charges }
