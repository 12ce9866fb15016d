open Dolphin_semantics
open Dolphin_json
open Dolphin_geo
open Codec

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

(* {1 Members} *)

(* Impossible values of a vehicle are not read: a share is from 0 to 1, metres are near the earth. *)
let from_zero = number ~least:0. ()
let metres = number ~least:(-.Position.highest) ~most:Position.highest ()

(* Limit on times: a million of the longest waits, one after the other. *)
let moment = named "time" (number ~least:0. ~most:(1e6 *. Time.longest) ())
let time_field = one "time" moment ~doc:"seconds since the start"

let position = Header.place

let progress =
  let digest = limited [ ("maxLength", `Int 32) ] text in
  let fields =
    let+ whole = field "plan" digest fst
    and+ share = field "share" (number ~least:0. ~most:1. ()) snd in
    (whole, share)
  in
  list (record fields)

let state =
  let readings =
    let sorted found = Ok (List.sort Stdlib.compare found) in
    conv sorted Fun.id (map (number ()))
  in
  let+ id = field "vehicle" text (fun (s : World.vehicle_state) -> s.id)
  and+ kind = field "type" text (fun (s : World.vehicle_state) -> s.kind)
  and+ payload = field "payload" (list text) (fun (s : World.vehicle_state) -> s.payload)
  and+ position = part (fun (s : World.vehicle_state) -> s.position) position
  and+ battery =
    field "battery" (nullable (number ~least:0. ~most:1. ())) (fun (s : World.vehicle_state) -> s.battery)
      ~doc:"a share; null: not known"
  and+ connected = field "connected" truth (fun (s : World.vehicle_state) -> s.connected)
  and+ depth = optional "depth" metres (fun (s : World.vehicle_state) -> s.depth) ~doc:"metres"
  and+ altitude = optional "altitude" metres (fun (s : World.vehicle_state) -> s.altitude) ~doc:"metres"
  and+ speed = optional "speed" ~null:true from_zero (fun (s : World.vehicle_state) -> s.speed) ~doc:"m/s"
  and+ readings = default [] "readings" readings (fun (s : World.vehicle_state) -> s.readings)
  and+ unready = optional "unready" text (fun (s : World.vehicle_state) -> s.unready)
  and+ cruise = optional "cruise" from_zero (fun (s : World.vehicle_state) -> s.cruise) ~doc:"m/s"
  and+ drain = optional "drain" from_zero (fun (s : World.vehicle_state) -> s.drain)
  and+ progress =
    default [] "progress" progress (fun (s : World.vehicle_state) -> s.progress)
      ~doc:"in its plans, by their digests, the latest first" in
  { World.id; kind; payload; position; depth; altitude; battery; speed; readings; connected; unready; cruise; drain;
    progress }

let of_state = Codec.members state
let to_state = Codec.of_members state

(* A ten-millionth of a degree is a centimetre. *)
let way_place =
  let degrees x = Float.round (x *. 1e7) /. 1e7 in
  let of_list = function
    | [ latitude; longitude ] ->
      Result.map_error (Format.asprintf "%a" Position.pp_error) (Position.make ~latitude ~longitude ~height:0.)
    | _ -> Error "not a place: [latitude, longitude]"
  in
  let to_list (p : Position.t) = [ degrees p.latitude; degrees p.longitude ] in
  conv of_list to_list (limited [ ("minItems", `Int 2); ("maxItems", `Int 2) ] (list (number ())))

let way =
  let of_path = function None -> By_name | Some ps -> Path ps
  and to_path = function By_name -> None | Path ps -> Some ps in
  conv (fun ps -> Ok (of_path ps)) to_path (nullable (limited [ ("minItems", `Int 1) ] (list way_place)))

(* {1 Kinds} *)

let vehicle = case "vehicle" (time_field @& state) (fun (time, state) -> Vehicle { time; state })
let event = case "event" (time_field @& Event.fields) (fun (time, event) -> Event { time; event })

let transition =
  case "transition"
    (time_field @& one "i" count @& Step.fields @& default [] "ways" (map way) Fun.id ~doc:"of vehicles that start")
    (fun (time, (index, (step, ways))) -> Transition { time; index; step; ways })

(* A partial trace may be without times. *)
let label =
  let time = default 0. "time" moment Fun.id ~always:true in
  let text = limited [ ("minLength", `Int 1) ] text in
  case "label" (time @& one "label" text) (fun (time, label) -> Label { time; label })

let platform =
  case "platform" (time_field @& one "vehicle" text @& one "note" object_) (fun (time, (vehicle, note)) ->
      Note { time; vehicle; note })

let operator = case "operator" (time_field @& Act.fields) (fun (time, act) -> Act { time; act })

let resumed =
  case "resumed" (time_field @& one "program" Header.source_codec @& one "at" Header.utc)
    (fun (time, (program, at)) -> Resumed { time; program; at })

let end_ =
  case "end" (time_field @& one "transitions" count @& Request.ending_fields) (fun (time, (transitions, ending)) ->
      End { time; transitions; ending })

let kinds =
  [ Case vehicle; Case event; Case transition; Case label; Case platform; Case operator; Case resumed; Case end_ ]

let choose = function
  | Vehicle { time; state } -> Is (vehicle, (time, state))
  | Event { time; event = e } -> Is (event, (time, e))
  | Transition { time; index; step; ways } -> Is (transition, (time, (index, (step, ways))))
  | Label { time; label = text } -> Is (label, (time, text))
  | Note { time; vehicle; note } -> Is (platform, (time, (vehicle, note)))
  | Act { time; act } -> Is (operator, (time, act))
  | Resumed { time; program; at } -> Is (resumed, (time, (program, at)))
  | End { time; transitions; ending } -> Is (end_, (time, (transitions, ending)))
  | Header _ | Partial _ -> invalid_arg "Entry.choose: a first line"

(* {1 Lines} *)

let line =
  record
    (let+ entry = part fst (union ~tag:"kind" kinds choose)
     and+ notes = optional "notes" (whole ()) snd ~doc:"notes of platforms so far" in
     (entry, notes))

let some_texts = limited [ ("minItems", `Int 1) ] (list text)

(* Which labels a trace has: all, or those of some kinds. *)
let observed =
  let all = form (const (`String "all")) (fun () -> [])
  and some =
    let not_empty = function [] -> Error "an empty list: a trace with no labels" | found -> Ok found in
    form (conv not_empty Fun.id some_texts) Fun.id
  in
  either
    (function `String "all" -> Form all | _ -> Form some)
    (function [] -> As (all, ()) | found -> As (some, found))
    [ Form all; Form some ]

let partial =
  named "partial"
    (record
       (let+ () = Header.format_fields ()
        and+ observed = field "observed" observed Fun.id ~doc:"kinds of labels" in
        observed))

let codec =
  let header = form Header.codec (fun h -> (Header h, None))
  and partial = form partial (fun observed -> (Partial { observed }, None))
  and line = form line Fun.id in
  let recognise : json -> _ = function
    | `Assoc found when List.mem_assoc "observed" found -> Form partial
    | `Assoc (("format", _) :: _) -> Form header
    | _ -> Form line
  in
  let choose = function
    | Header h, _ -> As (header, h)
    | Partial { observed }, _ -> As (partial, observed)
    | numbered -> As (line, numbered)
  in
  either recognise choose [ Form header; Form partial; Form line ]

let to_string ?notes entry = to_string codec (entry, notes)

let first_of_json json =
  match json with
  | `Assoc found when List.mem_assoc "observed" found ->
    Result.bind (Header.check_format json) (fun () ->
        Result.map (fun observed -> Partial { observed }) (read partial json))
  | json -> Result.map (fun h -> Header h) (Header.of_json json)

let first_of_string line = first_of_json (Result.value (Host_value.parse line) ~default:`Null)

let of_numbered_string text =
  match Host_value.parse text with
  | Error why -> Error ("this is not JSON: " ^ why)
  | Ok (`Assoc (("format", _) :: _) as json) -> Result.map (fun entry -> (entry, None)) (first_of_json json)
  | Ok (`Assoc _ as json) -> read line json
  | Ok _ -> Error "this is not JSON object"

let of_string line = Result.map fst (of_numbered_string line)
