open Dolphin_json.Field

type source = { path : string; hash : string; set : (string * string) list }

type t = {
  program : source;
  fleet : source option;
  platform : string;
  order : Dolphin_semantics.World.order;
  seed : int;
  speed : float option;
  started : string;
  run : string option;
  fences : Dolphin_plans.Fences.fence list;
  place : Dolphin_geo.Position.t option;
}

let format = "dolphin-journal"
let version = 1
let source ?(set = []) ~path text = { path; hash = Digest.to_hex (Digest.string text); set }

let of_source s : Yojson.Safe.t =
  let of_setting (x, text) = (x, `String text) in
  let set = if s.set = [] then [] else [ ("set", `Assoc (List.map of_setting s.set)) ] in
  `Assoc ([ ("path", `String s.path); ("md5", `String s.hash) ] @ set)

(* {1 Times} *)

(* Years and months count from March here: leap days then come last, and each five months have 153 days. *)
let days ~year ~month ~day =
  let years, months = if month >= 3 then (year, month - 3) else (year - 1, month + 9) in
  let since_year_0 = (365 * years) + (years / 4) - (years / 100) + (years / 400) + (((153 * months) + 2) / 5) in
  since_year_0 + day - 1 - 719468

let of_utc text =
  match Scanf.sscanf text "%4d-%2d-%2dT%2d:%2d:%2dZ%!" (fun y m d h min s -> (y, m, d, h, min, s)) with
  | year, month, day, h, min, s when year >= 1970 && month >= 1 && month <= 12 ->
    Some (float_of_int ((days ~year ~month ~day * 86400) + (h * 3600) + (min * 60) + s))
  | _ | (exception (Scanf.Scan_failure _ | Failure _ | End_of_file)) -> None

(* {1 JSON} *)

let of_place (p : Dolphin_geo.Position.t) : Yojson.Safe.t =
  let number = Dolphin_json.Canonical.number in
  `Assoc
    [ ("latitude", number p.latitude); ("longitude", number p.longitude); ("height", number p.height) ]

let to_place json =
  let* found = members json in
  let* latitude = get number "latitude" found in
  let* longitude = get number "longitude" found in
  let* height = get number "height" found in
  let place = Dolphin_geo.Position.make ~latitude ~longitude ~height in
  Result.map_error (Format.asprintf "%a" Dolphin_geo.Position.pp_error) place

let format_members : members = [ ("format", `String format); ("version", `Int version) ]

let of_order : Dolphin_semantics.World.order -> members = function
  | By_hearing -> []
  | By_id -> [ ("order", `String "id") ]

let to_order json : (Dolphin_semantics.World.order, string) result =
  match json with
  | `String "id" -> Ok By_id
  | _ -> Error "the order of vehicles is \"id\" or absent"

let to_json h : Yojson.Safe.t =
  `Assoc
    (format_members
     @ [ ("program", of_source h.program);
         ("fleet", of_option of_source h.fleet);
         ("platform", `String h.platform);
         ("seed", `Int h.seed);
         ("speed", of_option Dolphin_json.Canonical.number h.speed);
         ("started", `String h.started) ]
     @ Option.fold h.run ~none:[] ~some:(fun run -> [ ("run", `String run) ])
     @ of_order h.order
     @ unless_empty "fences" (fun fences -> `List (List.map Dolphin_json.On_map.fence fences)) h.fences
     @ Option.fold h.place ~none:[] ~some:(fun place -> [ ("place", of_place place) ]))

let to_settings json =
  let add settings (x, value) =
    let* settings = settings in
    Result.map (fun text -> (x, text) :: settings) (text value)
  in
  let* found = members json in
  Result.map List.rev (List.fold_left add (Ok []) found)

let to_source json =
  let* found = members json in
  let* path = get text "path" found in
  let* hash = get text "md5" found in
  let* set = optional to_settings ~default:[] "set" found in
  Ok { path; hash; set }

let check_format json =
  match json with
  | `Assoc found when List.assoc_opt "format" found = Some (`String format) ->
    let* its_version = get whole "version" found in
    if its_version = version then Ok ()
    else Error (Printf.sprintf "this journal is of version %d; version %d is known here" its_version version)
  | _ -> Error "this is not a journal: its first line is not the header of one"

let positive json =
  let* x = number json in
  if x > 0. then Ok x else Error (Printf.sprintf "%g, not a number above 0" x)

let of_json json =
  let* () = check_format json in
  let* found = members json in
  let* program = get to_source "program" found in
  let* fleet = get (nullable to_source) "fleet" found in
  let* platform = get text "platform" found in
  let* run = optional (fun json -> Result.map Option.some (text json)) ~default:None "run" found in
  let* order = optional to_order ~default:By_hearing "order" found in
  let* seed = get whole "seed" found in
  let* speed = get (nullable positive) "speed" found in
  let* started = get text "started" found in
  let* fences = optional (list Dolphin_json.On_map.to_fence) ~default:[] "fences" found in
  let* place = optional (fun json -> Result.map Option.some (to_place json)) ~default:None "place" found in
  Ok { program; fleet; platform; order; seed; speed; started; run; fences; place }
