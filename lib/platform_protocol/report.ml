open Dolphin_semantics
open Dolphin_json
open Dolphin_geo
open Codec

type greeting = {
  version : int;
  name : string;
  adapter : string option;
  plans : string list;
  announce : float;
  patience : float;
}

type sight = {
  vehicle : Core.vehicle;
  kind : string option;
  payload : string list option;
  place : (float * float) option;
  height : float option;
  depth : float option option;
  altitude : float option option;
  battery : float option option;
  speed : float option option;
  readings : (string * float option) list;
  link : bool option;
  unready : string option option;
}

let nothing vehicle =
  { vehicle; kind = None; payload = None; place = None; height = None; depth = None; altitude = None;
    battery = None; speed = None; readings = []; link = None; unready = None }

type word =
  | Taken
  | Progress of { share : float option; remaining : float option }
  | Done
  | Failed of string
  | Stopped
  | Unknown of string
  | Absent

type t =
  | Hello of greeting
  | Trouble of string
  | Vehicle of sight
  | Gone of Core.vehicle
  | Pong of int
  | Request of string * word
  | Checked of { id : int; problems : string list }
  | Note of { request : string; note : Yojson.Safe.t; id : int option }
  | Log of { vehicle : Core.vehicle option; text : string }
  | Quiet

let is_end = function Done | Failed _ | Stopped | Absent -> true | Taken | Progress _ | Unknown _ -> false

(* {1 Kinds} *)

(* A member that is [null] counts as absent, if [null] does not have a meaning of its own. *)
let absent ?doc name codec get = optional ?doc ~null:true name codec get
let as_before ?doc name codec get = optional ?doc name (nullable codec) get

let platform_name =
  let fits = function 'A' .. 'Z' | 'a' .. 'z' | '0' .. '9' | '-' | '_' -> true | _ -> false in
  let check name =
    if String.for_all fits name then Ok name
    else Error (Printf.sprintf "'%s', not a name of letters, digits, '-' and '_'" name)
  in
  limited [ ("pattern", `String "^[A-Za-z0-9_-]+$") ] (conv check Fun.id word)

let hello =
  case "hello"
    (let+ version = field "protocol" (Line.protocol ()) (fun g -> g.version)
     and+ name = field "name" platform_name (fun (g : greeting) -> g.name)
     and+ adapter = absent "version" text (fun g -> g.adapter) ~doc:"the version of the adapter"
     and+ plans =
       default [ "name" ] "plans" (list word) (fun g -> g.plans) ~null:true ~always:true ~doc:"the kinds of plans taken"
     and+ announce =
       default 10. "announce" Line.seconds (fun g -> g.announce) ~null:true ~always:true
         ~doc:"seconds after which every vehicle has been reported"
     and+ patience =
       default 30. "patience" Line.seconds (fun g -> g.patience) ~null:true ~always:true
         ~doc:"seconds within which orders are answered"
     in
     { version; name; adapter; plans; announce; patience })
    (fun greeting -> Hello greeting)

let place =
  let both = function
    | Some latitude, Some longitude -> Ok (Some (latitude, longitude))
    | None, None -> Ok None
    | Some _, None | None, Some _ -> Error "of latitude and longitude one is missing"
  in
  requiring
    [ ("latitude", [ "longitude" ]); ("longitude", [ "latitude" ]) ]
    (check both
       (let+ latitude = absent "latitude" (decimal ~least:(-90.) ~most:90. ()) (Option.map fst) ~doc:"degrees"
        and+ longitude = absent "longitude" (decimal ~least:(-180.) ~most:180. ()) (Option.map snd) ~doc:"degrees" in
        (latitude, longitude)))

(* As journals have them: a run whose journal cannot be read is not resumed. *)
let height = decimal ~least:Position.lowest ~most:Position.highest ()
let metres = decimal ~least:(-.Position.highest) ~most:Position.highest ()

let vehicle =
  case "vehicle"
    (let+ vehicle = field "vehicle" word (fun s -> s.vehicle)
     and+ kind = absent "type" word (fun s -> s.kind)
     and+ payload = absent "payload" (list text) (fun s -> s.payload)
     and+ place = part (fun s -> s.place) place
     and+ height = absent "height" height (fun s -> s.height) ~doc:"metres"
     and+ depth = as_before "depth" metres (fun s -> s.depth) ~doc:"metres; null: not known"
     and+ altitude = as_before "altitude" metres (fun s -> s.altitude) ~doc:"metres; null: not known"
     and+ battery =
       as_before "battery" (decimal ~least:0. ~most:1. ()) (fun s -> s.battery) ~doc:"a share; null: not known"
     and+ speed = as_before "speed" (decimal ~least:0. ()) (fun s -> s.speed) ~doc:"m/s; null: not known"
     and+ readings =
       default [] "readings" (map (nullable (decimal ()))) (fun s -> s.readings) ~null:true
         ~doc:"by quantity; null: not known any more"
     and+ link = absent "link" truth (fun s -> s.link)
     and+ unready = as_before "unready" word (fun s -> s.unready) ~doc:"null: nothing keeps it" in
     { vehicle; kind; payload; place; height; depth; altitude; battery; speed; readings; link; unready })
    (fun sight -> Vehicle sight)

let request = one "request" Line.request
let why = one "why" word
let on_request kind word = case kind request (fun r -> Request (r, word))
let because kind word = case kind (request @& why) (fun (r, why) -> Request (r, word why))
let error = case "error" why (fun why -> Trouble why)
let gone = case "gone" (one "vehicle" word) (fun v -> Gone v)
let pong = case "pong" (one "id" count) (fun id -> Pong id)
let taken = on_request "taken" Taken

let progress =
  case "progress"
    (request
     @& absent "share" (decimal ~least:0. ~most:1. ()) Fun.id
     @& absent "remaining" Line.seconds Fun.id ~doc:"seconds")
    (fun (r, (share, remaining)) -> Request (r, Progress { share; remaining }))

let done_ = on_request "done" Done
let failed = because "failed" (fun why -> Failed why)
let stopped = on_request "stopped" Stopped
let unknown = because "unknown" (fun why -> Unknown why)
let absent_ = on_request "absent" Absent

let checked =
  case "checked"
    (one "id" count @& one "problems" (list word))
    (fun (id, problems) -> Checked { id; problems })

let note =
  case "note"
    (request @& one "note" object_ @& absent "id" count Fun.id)
    (fun (request, (note, id)) -> Note { request; note; id })

let log =
  case "log" (absent "vehicle" word Fun.id @& one "text" text) (fun (vehicle, text) -> Log { vehicle; text })

let quiet = constant "quiet" Quiet

let variants =
  [ Case hello; Case error; Case vehicle; Case gone; Case pong; Case taken; Case progress; Case done_; Case failed;
    Case stopped; Case unknown; Case absent_; Case checked; Case note; Case log; Case quiet ]

let choose = function
  | Hello greeting -> Is (hello, greeting)
  | Trouble why -> Is (error, why)
  | Vehicle sight -> Is (vehicle, sight)
  | Gone v -> Is (gone, v)
  | Pong id -> Is (pong, id)
  | Request (r, Taken) -> Is (taken, r)
  | Request (r, Progress { share; remaining }) -> Is (progress, (r, (share, remaining)))
  | Request (r, Done) -> Is (done_, r)
  | Request (r, Failed why) -> Is (failed, (r, why))
  | Request (r, Stopped) -> Is (stopped, r)
  | Request (r, Unknown why) -> Is (unknown, (r, why))
  | Request (r, Absent) -> Is (absent_, r)
  | Checked { id; problems } -> Is (checked, (id, problems))
  | Note n -> Is (note, (n.request, (n.note, n.id)))
  | Log { vehicle; text } -> Is (log, (vehicle, text))
  | Quiet -> Is (quiet, ())

let codec = record (union ~tag:"kind" variants choose)
let to_json = write codec
let to_line report = to_string codec report ^ "\n"
let of_line text = Line.read variants text
let version = Line.version
let longest_line = Line.longest
