open Dolphin_json
open Codec

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
  begins : Dolphin_semantics.Calendar.t option;
}

let format = "dolphin-journal"
let version = 1
let source ?(set = []) ~path text = { path; hash = Digest.to_hex (Digest.string text); set }

let source_codec =
  named "source"
    (record
       (let+ path = field "path" text (fun s -> s.path)
        and+ hash = field "md5" (limited [ ("pattern", `String "^[0-9a-f]{32}$") ] text) (fun s -> s.hash)
        and+ set = default [] "set" (map text) (fun s -> s.set) ~doc:"parameters that were set" in
        { path; hash; set }))

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

let place =
  let of_parts (latitude, (longitude, height)) =
    Result.map_error (Format.asprintf "%a" Dolphin_geo.Position.pp_error)
      (Dolphin_geo.Position.make ~latitude ~longitude ~height)
  in
  let to_parts (p : Dolphin_geo.Position.t) = (p.latitude, (p.longitude, p.height)) in
  let degrees most = limited [ ("minimum", `Int (-most)); ("maximum", `Int most) ] (number ()) in
  let height = number ~least:Dolphin_geo.Position.lowest ~most:Dolphin_geo.Position.highest () in
  let latitude = one "latitude" (degrees 90) ~doc:"degrees"
  and longitude = one "longitude" (degrees 180) ~doc:"degrees" in
  check of_parts (part to_parts (latitude @& longitude @& one "height" height ~doc:"metres"))

let format_fields () =
  let+ () = fixed "format" (`String format)
  and+ () = fixed "version" (`Int version) in
  ()

let format_members = Codec.members (format_fields ()) ()

let check_format json =
  match json with
  | `Assoc found when List.assoc_opt "format" found = Some (`String format) ->
    let its_version = Codec.of_members (one "version" (whole ())) found in
    Result.bind its_version (fun its_version ->
        if its_version = version then Ok ()
        else Error (Printf.sprintf "this journal is of version %d; version %d is known here" its_version version))
  | _ -> Error "this is not a journal: its first line is not the header of one"

let positive =
  let check x = if x > 0. then Ok x else Error (Printf.sprintf "%g, not a number above 0" x) in
  limited [ ("exclusiveMinimum", `Int 0) ] (conv check Fun.id (number ()))

let utc = limited [ ("pattern", `String "^[0-9]{4}-[0-9]{2}-[0-9]{2}T[0-9]{2}:[0-9]{2}:[0-9]{2}Z$") ] text

let date =
  let pattern = "^[0-9]{4}-[0-9]{2}-[0-9]{2}T[0-9]{2}:[0-9]{2}:[0-9]{2}[+-][0-9]{2}:[0-9]{2}$" in
  let written = Format.asprintf "%a" Dolphin_semantics.Calendar.pp in
  limited [ ("pattern", `String pattern) ] (conv Dolphin_semantics.Calendar.of_string written text)

let codec =
  let order = enum [ ("id", Dolphin_semantics.World.By_id) ] in
  named "header"
    (record
       (let+ () = format_fields ()
        and+ program = field "program" source_codec (fun h -> h.program)
        and+ fleet = field "fleet" (nullable source_codec) (fun h -> h.fleet) ~doc:"null: the built-in fleet"
        and+ platform = field "platform" text (fun h -> h.platform)
        and+ seed = field "seed" (whole ()) (fun h -> h.seed)
        and+ speed =
          field "speed" (nullable positive) (fun h -> h.speed)
            ~doc:"of a simulation, times real time; null: as fast as it goes"
        and+ started = field "started" utc (fun h -> h.started)
        and+ run = optional "run" text (fun h -> h.run) ~doc:"of a run on vehicles of a network: its identity"
        and+ order = default Dolphin_semantics.World.By_hearing "order" order (fun h -> h.order) ~doc:"of vehicles"
        and+ fences = default [] "fences" (list On_map.fence) (fun h -> h.fences)
        and+ place =
          optional "place" (record place) (fun h -> h.place) ~doc:"of plans without one"
        and+ begins = optional "begins" date (fun h -> h.begins) ~doc:"the date 0, with its offset from UTC" in
        { program; fleet; platform; order; seed; speed; started; run; fences; place; begins }))

let to_json = write codec
let of_json json = Result.bind (check_format json) (fun () -> read codec json)
