open Dolphin_semantics
open Dolphin_json
open Codec

type purpose = Run | Look | Check

type doubt = Lost_order | Lost_notes

type t =
  | Hello of { version : int; dolphin : string; purpose : purpose; program : string option; resumes : bool }
  | Telemetry of bool
  | Hold of Core.vehicle list
  | Release of Core.vehicle list
  | Timeout of Core.vehicle list option * float
  | Ping of int
  | Start of { request : string; vehicle : Core.vehicle; plan : Yojson.Safe.t; timeout : float }
  | Stop of { request : string; vehicle : Core.vehicle }
  | Resume of {
      request : string;
      vehicle : Core.vehicle;
      plan : Yojson.Safe.t;
      timeout : float;
      notes : Yojson.Safe.t list;
      doubt : doubt option;
    }
  | Check of { id : int; vehicle : Core.vehicle option; plan : Yojson.Safe.t }
  | Kept of int
  | Refused of string
  | Close

let purpose = enum [ ("run", Run); ("look", Look); ("check", (Check : purpose)) ]
let doubts = [ ("order", Lost_order); ("notes", Lost_notes) ]
let name_of_doubt doubt = fst (List.find (fun (_, other) -> other = doubt) doubts)

(* {1 Members} *)

let plan = elsewhere "plan.schema.json#" any
let note = limited [ ("type", `String "object") ] any
let vehicle get = field "vehicle" word get
let vehicles = one "vehicles" (list word)
let id = one "id" count

(* A reason may quote what was not even UTF-8. *)
let ascii =
  let shown = String.map (function ' ' .. '~' as c -> c | _ -> '?') in
  conv (fun why -> Ok (shown why)) shown text

(* Doubts of later versions are unknown. *)
let doubt =
  let names = limited [ ("enum", `List (List.map (fun (name, _) -> `String name) doubts)) ] word in
  let+ name = optional "doubt" ~null:true names Fun.id ~doc:"what may be lost of this request, with its end" in
  Option.bind name (fun name -> List.assoc_opt name doubts)

type task = { request : string; vehicle : Core.vehicle; plan : Yojson.Safe.t; timeout : float }

let task =
  let+ request = field "request" Line.request (fun t -> t.request)
  and+ vehicle = vehicle (fun t -> t.vehicle)
  and+ plan = field "plan" plan (fun t -> t.plan)
  and+ timeout = field "timeout" Line.seconds (fun t -> t.timeout) ~doc:"the connection timeout, in seconds" in
  { request; vehicle; plan; timeout }

(* {1 Kinds} *)

type greeting = { version : int; dolphin : string; purpose : purpose; program : string option; resumes : bool }

let hello =
  case "hello"
    (let+ version = field "protocol" (Line.protocol ()) (fun h -> h.version)
     and+ dolphin = field "dolphin" text (fun h -> h.dolphin) ~doc:"the version of Dolphin"
     and+ purpose = field "purpose" purpose (fun h -> h.purpose)
     and+ program = optional "program" ~null:true word (fun h -> h.program)
     and+ resumes = field "resumes" truth (fun h -> h.resumes) ~doc:"whether a run is taken up again" in
     { version; dolphin; purpose; program; resumes })
    (fun { version; dolphin; purpose; program; resumes } -> Hello { version; dolphin; purpose; program; resumes })

let telemetry = case "telemetry" (one "on" truth) (fun on -> Telemetry on)
let hold = case "hold" vehicles (fun vs -> Hold vs)
let release = case "release" vehicles (fun vs -> Release vs)

let timeout =
  case "timeout"
    (one "vehicles" (nullable (list word)) ~doc:"null: all of them, present and future"
     @& one "seconds" Line.seconds)
    (fun (vehicles, seconds) -> Timeout (vehicles, seconds))

let ping = case "ping" id (fun id -> Ping id)

let start =
  case "start" task (fun { request; vehicle; plan; timeout } -> Start { request; vehicle; plan; timeout })

let stop =
  case "stop"
    (one "request" Line.request @& vehicle Fun.id)
    (fun (request, vehicle) -> Stop { request; vehicle })

let resume =
  case "resume"
    (task @& one "notes" (list note) ~doc:"latest first" @& part (Option.map name_of_doubt) doubt)
    (fun ({ request; vehicle; plan; timeout }, (notes, doubt)) ->
       Resume { request; vehicle; plan; timeout; notes; doubt })

let check =
  case "check"
    (id @& one "plan" plan @& optional "vehicle" ~null:true word Fun.id)
    (fun (id, (plan, vehicle)) -> Check { id; vehicle; plan })

let kept = case "kept" id (fun id -> Kept id)
let refused = case "refused" (one "why" ascii) (fun why -> Refused why)
let close = constant "close" Close

let variants =
  [ Case hello; Case telemetry; Case hold; Case release; Case timeout; Case ping; Case start; Case stop; Case resume;
    Case check; Case kept; Case refused; Case close ]

let choose = function
  | Hello { version; dolphin; purpose; program; resumes } ->
    Is (hello, { version; dolphin; purpose; program; resumes })
  | Telemetry on -> Is (telemetry, on)
  | Hold vehicles -> Is (hold, vehicles)
  | Release vehicles -> Is (release, vehicles)
  | Timeout (vehicles, seconds) -> Is (timeout, (vehicles, seconds))
  | Ping id -> Is (ping, id)
  | Start { request; vehicle; plan; timeout } -> Is (start, { request; vehicle; plan; timeout })
  | Stop { request; vehicle } -> Is (stop, (request, vehicle))
  | Resume { request; vehicle; plan; timeout; notes; doubt } ->
    Is (resume, ({ request; vehicle; plan; timeout }, (notes, doubt)))
  | Check { id; vehicle; plan } -> Is (check, (id, (plan, vehicle)))
  | Kept id -> Is (kept, id)
  | Refused why -> Is (refused, why)
  | Close -> Is (close, ())

let codec = record (union ~tag:"kind" variants choose)
let to_json = write codec
let to_line order = to_string codec order ^ "\n"
let of_line text = Line.read variants text
