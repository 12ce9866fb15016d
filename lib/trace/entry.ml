open Dolphin_semantics
open Dolphin_json
open Dolphin_geo
open Field

type way = Path of Position.t list | By_name

type t =
  | Header of Header.t
  | Partial of { observed : string list }
  | Label of { time : float; label : string }
  | Vehicle of { time : float; state : World.vehicle_state }
  | Event of { time : float; event : Event.t }
  | Transition of { time : float; index : int; step : Step.t; ways : (Core.vehicle * way) list }
  | Note of { time : float; vehicle : Core.vehicle; note : Yojson.Safe.t }
  | Act of { time : float; act : Act.t }
  | Resumed of { time : float; program : Header.source; at : string }
  | End of { time : float; transitions : int; ending : Request.ending }

let time = function
  | Header _ | Partial _ -> 0.
  | Label { time; _ } | Vehicle { time; _ } | Event { time; _ } | Transition { time; _ } | Note { time; _ }
  | Act { time; _ } | Resumed { time; _ } | End { time; _ } -> time

(* {1 Writing} *)

let of_position (p : Position.t) : members =
  [ ("latitude", Canonical.number p.latitude); ("longitude", Canonical.number p.longitude);
    ("height", Canonical.number p.height) ]

let of_state (s : World.vehicle_state) : members =
  [ ("vehicle", `String s.id); ("type", `String s.kind); ("payload", texts s.payload) ]
  @ of_position s.position
  @ [ ("battery", Option.fold s.battery ~none:`Null ~some:Canonical.number); ("connected", `Bool s.connected) ]
  @ Option.fold s.depth ~none:[] ~some:(fun x -> [ ("depth", Canonical.number x) ])
  @ Option.fold s.altitude ~none:[] ~some:(fun x -> [ ("altitude", Canonical.number x) ])
  @ Option.fold s.speed ~none:[] ~some:(fun x -> [ ("speed", Canonical.number x) ])
  @ (if s.readings = [] then []
     else [ ("readings", `Assoc (List.map (fun (name, x) -> (name, Canonical.number x)) s.readings)) ])
  @ Option.fold s.unready ~none:[] ~some:(fun why -> [ ("unready", `String why) ])
  @ Option.fold s.cruise ~none:[] ~some:(fun speed -> [ ("cruise", Canonical.number speed) ])
  @ Option.fold s.drain ~none:[] ~some:(fun share -> [ ("drain", Canonical.number share) ])

(* A ten-millionth of a degree is a centimetre. *)
let of_way : way -> Yojson.Safe.t = function
  | By_name -> `Null
  | Path ps ->
    let degrees x = Canonical.number (Float.round (x *. 1e7) /. 1e7) in
    `List (List.rev (List.rev_map (fun (p : Position.t) -> `List [ degrees p.latitude; degrees p.longitude ]) ps))

let of_ways ways : Yojson.Safe.t = `Assoc (List.map (fun (v, way) -> (v, of_way way)) ways)

let to_json entry : Yojson.Safe.t =
  let line kind time rest = `Assoc (("kind", `String kind) :: ("time", Canonical.number time) :: rest) in
  match entry with
  | Header h -> Header.to_json h
  | Partial { observed } ->
    let all : Yojson.Safe.t = if observed = [] then `String "all" else texts observed in
    `Assoc (Header.format_members @ [ ("observed", all) ])
  | Label { time; label } -> line "label" time [ ("label", `String label) ]
  | Vehicle { time; state } -> line "vehicle" time (of_state state)
  | Event { time; event } -> line "event" time (Event.members event)
  | Transition { time; index; step; ways } ->
    line "transition" time (("i", `Int index) :: Step.members step @ unless_empty "ways" of_ways ways)
  | Note { time; vehicle; note } -> line "platform" time [ ("vehicle", `String vehicle); ("note", note) ]
  | Act { time; act } -> line "operator" time (Act.members act)
  | Resumed { time; program; at } ->
    line "resumed" time [ ("program", Header.of_source program); ("at", `String at) ]
  | End { time; transitions; ending } ->
    line "end" time (("transitions", `Int transitions) :: Request.ending_members ending)

let to_string ?notes entry =
  match notes, to_json entry with
  | Some n, `Assoc members -> Canonical.to_string (`Assoc (members @ [ ("notes", `Int n) ]))
  | (Some _ | None), json -> Canonical.to_string json

(* {1 Reading} *)

(* Impossible values of a vehicle are not read: a share is from 0 to 1, metres are near the earth. *)
let between low high json =
  let* x = number json in
  if x >= low && x <= high then Ok x else Error (Printf.sprintf "%g, not from %g to %g" x low high)

let from_zero json =
  let* x = number json in
  if x >= 0. then Ok x else Error (Printf.sprintf "%g, not a number from 0" x)

(* Limit on times: a million of the longest waits, one after the other. *)
let latest = 1e6 *. Time.longest
let moment = between 0. latest

let to_position found =
  let* latitude = get number "latitude" found in
  let* longitude = get number "longitude" found in
  let* height = get (between (-20_000.) 1e6) "height" found in
  Result.map_error (Format.asprintf "%a" Position.pp_error) (Position.make ~latitude ~longitude ~height)

let to_readings json =
  let reading (name, json) = Result.map (fun x -> (name, x)) (number json) in
  Result.bind (members json) (fun found -> Dolphin_results.Results.map reading (List.sort Stdlib.compare found))

let to_state found =
  let* id = get text "vehicle" found in
  let* kind = get text "type" found in
  let* payload = get (list text) "payload" found in
  let* position = to_position found in
  let* battery = get (nullable (between 0. 1.)) "battery" found in
  let rate json = Result.map Option.some (from_zero json) in
  let metres json = Result.map Option.some (between (-1e6) 1e6 json) in
  let* depth = optional metres ~default:None "depth" found in
  let* altitude = optional metres ~default:None "altitude" found in
  let* connected = get truth "connected" found in
  let* speed = optional (nullable from_zero) ~default:None "speed" found in
  let* readings = optional to_readings ~default:[] "readings" found in
  let* unready = optional (fun json -> Result.map Option.some (text json)) ~default:None "unready" found in
  let* cruise = optional rate ~default:None "cruise" found in
  let* drain = optional rate ~default:None "drain" found in
  Ok { World.id; kind; payload; position; depth; altitude; battery; speed; readings; connected; unready; cruise; drain }

let to_place json =
  match (json : Yojson.Safe.t) with
  | `List [ latitude; longitude ] ->
    let* latitude = number latitude in
    let* longitude = number longitude in
    Result.map_error (Format.asprintf "%a" Position.pp_error) (Position.make ~latitude ~longitude ~height:0.)
  | _ -> Error "a place is [latitude, longitude]"

let to_way : Yojson.Safe.t -> (way, string) result = function
  | `Null -> Ok By_name
  | json -> Result.map (fun ps -> Path ps) (list to_place json)

let to_ways json =
  let* found = members json in
  Dolphin_results.Results.map_values to_way found

let of_members found =
  let* kind = get text "kind" found in
  let* time = if kind = "label" then optional moment ~default:0. "time" found else get moment "time" found in
  match kind with
  | "label" -> Result.map (fun label -> Label { time; label }) (get text "label" found)
  | "vehicle" -> Result.map (fun state -> Vehicle { time; state }) (to_state found)
  | "event" -> Result.map (fun event -> Event { time; event }) (Event.of_members found)
  | "transition" ->
    let* index = get whole "i" found in
    let* step = Step.of_members found in
    let* ways = optional to_ways ~default:[] "ways" found in
    Ok (Transition { time; index; step; ways })
  | "platform" ->
    let* vehicle = get text "vehicle" found in
    let* note = get members "note" found in
    Ok (Note { time; vehicle; note = `Assoc note })
  | "operator" -> Result.map (fun act -> Act { time; act }) (Act.of_members found)
  | "resumed" ->
    let* program = get Header.to_source "program" found in
    let* at = get text "at" found in
    Ok (Resumed { time; program; at })
  | "end" ->
    let* transitions = get whole "transitions" found in
    let* ending = Request.ending_of_members found in
    Ok (End { time; transitions; ending })
  | other -> Error (Printf.sprintf "unknown kind of line: %S" other)

(* Which labels a trace has: all, or those of some kinds. *)
let to_observed : Yojson.Safe.t -> (string list, string) result = function
  | `String "all" -> Ok []
  | json -> (
      match list text json with
      | Ok [] -> Error "an empty list: a trace with no labels"
      | found -> found)

let first_of_json json =
  match json with
  | `Assoc found when List.mem_assoc "observed" found ->
    let* () = Header.check_format json in
    Result.map (fun observed -> Partial { observed }) (get to_observed "observed" found)
  | json -> Result.map (fun h -> Header h) (Header.of_json json)

let first_of_string line = first_of_json (Result.value (Host_value.parse line) ~default:`Null)

let of_numbered_string line =
  match Host_value.parse line with
  | Error why -> Error ("this is not JSON: " ^ why)
  | Ok (`Assoc (("format", _) :: _) as json) -> Result.map (fun entry -> (entry, None)) (first_of_json json)
  | Ok (`Assoc found) ->
    let* entry = of_members found in
    let* notes = optional (fun json -> Result.map Option.some (whole json)) ~default:None "notes" found in
    Ok (entry, notes)
  | Ok _ -> Error "this is not JSON object"

let of_string line = Result.map fst (of_numbered_string line)
