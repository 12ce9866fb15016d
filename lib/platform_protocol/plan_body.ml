open Dolphin_plans
open Dolphin_semantics
open Dolphin_geo
open Dolphin_json
open Codec

(* {1 Places} *)

let metres = decimal ()

let location get =
  let of_parts (latitude, (longitude, height)) =
    Result.map_error (Format.asprintf "%a" Position.pp_error) (Position.make ~latitude ~longitude ~height)
  in
  part get
    (check of_parts
       (part
          (fun (p : Position.t) -> (p.latitude, (p.longitude, p.height)))
          (one "latitude" (decimal ~least:(-90.) ~most:90. ()) ~doc:"degrees"
           @& one "longitude" (decimal ~least:(-180.) ~most:180. ()) ~doc:"degrees"
           @& one "height" metres ~doc:"metres")))

let place = named "position" (record (location Fun.id))

(* {1 Maneuvers} *)

let speed_unit = enum [ ("m/s", Plan.Metres_per_second); ("rpm", Revolutions_per_minute); ("percent", Percent) ]

let z_unit =
  enum [ ("depth", Plan.Depth); ("altitude", Altitude); ("height", Height); ("unspecified", Unspecified) ]

let direction =
  one "direction"
    (named "direction"
       (enum
          [ ("vehicle-dependent", Plan.Vehicle_dependent); ("clockwise", Clockwise);
            ("counter-clockwise", Counter_clockwise); ("into-wind-or-current", Into_wind_or_current) ]))

let is_whole x = if Float.is_integer x then Ok x else Error (Printf.sprintf "%g, not a whole number" x)

let duration =
  one "duration" (limited [ ("multipleOf", `Int 1) ] (conv is_whole Fun.id (decimal ~least:0. ()))) ~doc:"seconds"

let radius = one "radius" metres
let amplitude = one "amplitude" metres
let degrees name = one name (decimal ()) ~doc:"degrees"
let flag name = one name truth

let point =
  let of_list = function
    | [ north; east; down ] -> Ok (north, east, down)
    | _ -> Error "not a point: [north, east, down]"
  in
  conv of_list (fun (north, east, down) -> [ north; east; down ]) (list ~least:3 ~most:3 metres)

let go_to = constant "goTo" Plan.Go_to
let launch = constant "launch" Plan.Launch

let loiter =
  case "loiter" (radius @& duration @& direction) (fun (radius, (duration, direction)) ->
      Plan.Loiter { radius; duration; direction })

let yo_yo =
  case "yoyo" (amplitude @& degrees "pitch") (fun (amplitude, pitch) -> Plan.Yo_yo { amplitude; pitch })

let pop_up =
  case "popup" (duration @& flag "currentPosition" @& flag "waitAtSurface" @& flag "stationKeep")
    (fun (duration, (current_position, (wait_at_surface, station_keep))) ->
       Plan.Pop_up { duration; current_position; wait_at_surface; station_keep })

let station_keeping =
  case "skeeping" (radius @& duration) (fun (radius, duration) -> Plan.Station_keeping { radius; duration })

let compass_calibration =
  case "compassCalibration" (amplitude @& radius @& degrees "pitch" @& duration @& direction)
    (fun (amplitude, (radius, (pitch, (duration, direction)))) ->
       Plan.Compass_calibration { amplitude; radius; pitch; duration; direction })

let rows =
  case "rows"
    (degrees "bearing" @& degrees "crossAngle" @& one "width" metres @& one "length" metres
     @& one "horizontalStep" metres @& one "curveOffset" metres @& one "alternation" (decimal ()) ~doc:"percent"
     @& flag "squareCurve" @& flag "firstCurveRight")
    (fun (bearing,
          (cross_angle,
           (width, (length, (horizontal_step, (curve_offset, (alternation, (square_curve, first_curve_right)))))))) ->
      Plan.Rows
        { bearing; cross_angle; width; length; horizontal_step; curve_offset; alternation; square_curve;
          first_curve_right })

let follow_path =
  case "followPath" (one "points" (list point) ~doc:"metres north, east and down") (fun points ->
      Plan.Follow_path points)

let kinds =
  [ Case go_to; Case launch; Case loiter; Case yo_yo; Case pop_up; Case station_keeping; Case compass_calibration;
    Case rows; Case follow_path ]

let choose : Plan.kind -> _ = function
  | Go_to -> Is (go_to, ())
  | Launch -> Is (launch, ())
  | Loiter { radius; duration; direction } -> Is (loiter, (radius, (duration, direction)))
  | Yo_yo { amplitude; pitch } -> Is (yo_yo, (amplitude, pitch))
  | Pop_up { duration; current_position; wait_at_surface; station_keep } ->
    Is (pop_up, (duration, (current_position, (wait_at_surface, station_keep))))
  | Station_keeping { radius; duration } -> Is (station_keeping, (radius, duration))
  | Compass_calibration { amplitude; radius; pitch; duration; direction } ->
    Is (compass_calibration, (amplitude, (radius, (pitch, (duration, direction)))))
  | Rows r ->
    Is
      ( rows,
        ( r.bearing,
          ( r.cross_angle,
            ( r.width,
              ( r.length,
                ( r.horizontal_step,
                  (r.curve_offset, (r.alternation, (r.square_curve, r.first_curve_right))) ) ) ) ) ) )
  | Follow_path points -> Is (follow_path, points)

let payload =
  record
    (let+ name = field "name" word (fun (p : Plan.payload) -> p.name)
     and+ parameters = field "parameters" (map text) (fun (p : Plan.payload) -> p.parameters) in
     { Plan.name; parameters })

let maneuver =
  let common =
    let+ location = location (fun (m : Plan.maneuver) -> m.location)
    and+ z = field "z" metres (fun m -> fst m.Plan.z)
    and+ z_unit = field "zUnit" z_unit (fun m -> snd m.Plan.z)
    and+ speed = field "speed" (decimal ()) (fun m -> fst m.Plan.speed)
    and+ speed_unit = field "speedUnit" speed_unit (fun m -> snd m.Plan.speed)
    and+ payloads = field "payload" (list payload) (fun m -> m.Plan.payloads) in
    { Plan.id = ""; kind = Go_to; location; z = (z, z_unit); speed = (speed, speed_unit); payloads }
  in
  named "maneuver"
    (record
       (let+ id = field "id" word (fun (m : Plan.maneuver) -> m.id)
        and+ m, kind =
          part (fun (m : Plan.maneuver) -> (m, m.kind)) (union_around ~tag:"maneuver" common kinds choose) in
        { m with id; kind }))

(* The names of both are beside their language. *)
let imc_plan =
  named "imcPlan"
    (record
       (let+ description = field "description" text (fun (p : Plan.t) -> p.description)
        and+ vehicles = field "vehicles" (list word) (fun (p : Plan.t) -> p.vehicles)
        and+ maneuvers = field "maneuvers" (list ~least:1 maneuver) (fun (p : Plan.t) -> p.maneuvers) in
        { Plan.name = ""; description; vehicles; maneuvers }))

(* {1 Missions} *)

let argument =
  let number = form (decimal ()) (fun x -> Mission_plan.Number x)
  and truth = form truth (fun b -> Mission_plan.Truth b)
  and text = form text (fun text -> Mission_plan.Text text)
  and a_place = form place (fun p -> Mission_plan.Place p)
  and places = form (list place) (fun ps -> Mission_plan.Places ps) in
  let recognise : json -> _ = function
    | `Bool _ -> Form truth
    | `String _ -> Form text
    | `Assoc _ -> Form a_place
    | `List _ -> Form places
    | _ -> Form number
  in
  let choose : Mission_plan.argument -> _ = function
    | Number x -> As (number, x)
    | Truth b -> As (truth, b)
    | Text s -> As (text, s)
    | Place p -> As (a_place, p)
    | Places ps -> As (places, ps)
  in
  named "argument" (either recognise choose [ Form number; Form truth; Form text; Form a_place; Form places ])

(* Dolphin names every argument. *)
let unnamed codec =
  let none = function [] -> Ok [] | _ :: _ -> Error "not empty: arguments have names" in
  field "arguments" (conv none Fun.id (list codec)) (fun _ -> [])

(* The two items that permit something have one argument, of their own name. *)
let permission word codec make =
  let one_argument =
    let+ () = fixed "item" (`String word)
    and+ _ = unnamed codec
    and+ x = field "named" (closed (optional word codec Fun.id)) Fun.id in
    x
  in
  let argument x = (word, make x) in
  form (record one_argument) (fun x -> { Mission_plan.word; arguments = List.map argument (Option.to_list x) })

let item =
  let arm = permission "arm" truth (fun b -> Mission_plan.Truth b)
  and stored = permission "stored" word (fun text -> Mission_plan.Text text)
  and other =
    let others = `Assoc [ ("enum", `List [ `String "arm"; `String "stored" ]) ] in
    let fields =
      let+ word = field "item" (limited [ ("not", others) ] word) (fun (i : Mission_plan.item) -> i.word)
      and+ _ = unnamed argument
      and+ arguments = field "named" (map argument) (fun (i : Mission_plan.item) -> i.arguments) in
      { Mission_plan.word; arguments }
    in
    form (record fields) Fun.id
  in
  let recognise : json -> _ = function
    | `Assoc members when List.assoc_opt "item" members = Some (`String "arm") -> Form arm
    | `Assoc members when List.assoc_opt "item" members = Some (`String "stored") -> Form stored
    | _ -> Form other
  in
  let choose (i : Mission_plan.item) =
    match i.word, i.arguments with
    | "arm", [ ("arm", Truth b) ] -> As (arm, Some b)
    | "arm", [] -> As (arm, None)
    | "stored", [ ("stored", Text name) ] -> As (stored, Some name)
    | "stored", [] -> As (stored, None)
    | _, _ -> As (other, i)
  in
  named "item" (either recognise choose [ Form arm; Form stored; Form other ])

let mission =
  named "mission"
    (record
       (let+ vehicles = field "vehicles" (list word) (fun (m : Mission_plan.t) -> m.vehicles)
        and+ items = field "items" (list ~least:1 item) (fun (m : Mission_plan.t) -> m.items) in
        { Mission_plan.name = ""; vehicles; items }))

(* {1 Plans} *)

let name () = one "name" text

let by_name =
  let without = [ ("not", `Assoc [ ("required", `List [ `String "language" ]) ]) ] in
  form (limited without (record (name ()))) (fun name -> { Core.name; plan = None; task_site = 0 })

let in_language language body make =
  let fields =
    let+ name = part fst (name ())
    and+ () = fixed "language" (`String language)
    and+ body = field "body" body snd in
    (name, body)
  in
  form (record fields) (fun (name, body) -> { Core.name; plan = Some (make name body); task_site = 0 })

let maneuvers = in_language "imcPlan" imc_plan (fun name (p : Plan.t) -> Inline_plan.Maneuvers { p with name })
let items = in_language "mission" mission (fun name (m : Mission_plan.t) -> Inline_plan.Mission { m with name })

(* Those of other programs, which adapters may know. *)
let other =
  let not_known language = Error (Printf.sprintf "'%s', a language of plans that is not known here" language) in
  let known = `Assoc [ ("enum", `List [ `String "imcPlan"; `String "mission" ]) ] in
  let language = limited [ ("not", known) ] (conv not_known Fun.id word) in
  let fields =
    let+ name = part fst (name ())
    and+ language = field "language" language snd
    and+ _ = field "body" any (fun _ -> `Null) in
    (name, language)
  in
  form (record fields) (fun (name, _) -> { Core.name; plan = None; task_site = 0 })

let codec =
  let recognise : json -> _ = function
    | `Assoc members -> (
        match List.assoc_opt "language" members with
        | None | Some `Null -> Form by_name
        | Some (`String "imcPlan") -> Form maneuvers
        | Some (`String "mission") -> Form items
        | Some _ -> Form other)
    | _ -> Form by_name
  in
  let rec choose (task : Core.platform_task) =
    match task.plan with
    | None -> As (by_name, task.name)
    | Some (Maneuvers p) -> As (maneuvers, (task.name, p))
    | Some (Mission m) -> As (items, (task.name, m))
    | Some (Rest r) -> choose { task with plan = Some r.plan }
  in
  either recognise choose [ Form by_name; Form maneuvers; Form items; Form other ]

let to_json = write codec
let of_json = read codec

let rec language (task : Core.platform_task) =
  match task.plan with
  | None -> "name"
  | Some (Maneuvers _) -> "imcPlan"
  | Some (Mission _) -> "mission"
  | Some (Rest r) -> language { task with plan = Some r.plan }
