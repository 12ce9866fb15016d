open Dolphin_semantics
open Dolphin_json
open Field

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

let purposes = [ ("run", Run); ("look", Look); ("check", (Check : purpose)) ]
let name_of_purpose purpose = fst (List.find (fun (_, other) -> other = purpose) purposes)

let doubts = [ ("order", Lost_order); ("notes", Lost_notes) ]
let name_of_doubt doubt = fst (List.find (fun (_, other) -> other = doubt) doubts)

(* {1 Writing} *)

let text = Line.text
let optional_text name = function Some x -> [ (name, text x) ] | None -> []

(* A reason may quote what was not even UTF-8. *)
let ascii = String.map (function ' ' .. '~' as c -> c | _ -> '?')

let task request vehicle plan timeout =
  [ ("request", text request); ("vehicle", text vehicle); ("plan", plan); ("timeout", `Float timeout) ]

let to_json = function
  | Hello { version; dolphin; purpose; program; resumes } ->
    Line.make "hello"
      ([ ("protocol", `Int version); ("dolphin", text dolphin); ("purpose", text (name_of_purpose purpose)) ]
       @ optional_text "program" program
       @ [ ("resumes", `Bool resumes) ])
  | Telemetry on -> Line.make "telemetry" [ ("on", `Bool on) ]
  | Hold vehicles -> Line.make "hold" [ ("vehicles", texts vehicles) ]
  | Release vehicles -> Line.make "release" [ ("vehicles", texts vehicles) ]
  | Timeout (vehicles, seconds) ->
    Line.make "timeout" [ ("vehicles", of_option texts vehicles); ("seconds", `Float seconds) ]
  | Ping id -> Line.make "ping" [ ("id", `Int id) ]
  | Start { request; vehicle; plan; timeout } -> Line.make "start" (task request vehicle plan timeout)
  | Stop { request; vehicle } -> Line.make "stop" [ ("request", text request); ("vehicle", text vehicle) ]
  | Resume { request; vehicle; plan; timeout; notes; doubt } ->
    let doubt = Option.map name_of_doubt doubt in
    Line.make "resume" (task request vehicle plan timeout @ [ ("notes", `List notes) ] @ optional_text "doubt" doubt)
  | Check { id; vehicle; plan } ->
    Line.make "check" ([ ("id", `Int id); ("plan", plan) ] @ optional_text "vehicle" vehicle)
  | Kept id -> Line.make "kept" [ ("id", `Int id) ]
  | Refused why -> Line.make "refused" [ ("why", text (ascii why)) ]
  | Close -> Line.make "close" []

let to_line order = Canonical.to_string (to_json order) ^ "\n"

(* {1 Reading} *)

let absent_text = optional (nullable Line.word) ~default:None

let purpose json =
  let* name = Field.text json in
  match List.assoc_opt name purposes with
  | Some purpose -> Ok purpose
  | None -> Error (Printf.sprintf "'%s', not a purpose" name)

let hello members =
  let* version = get Line.count "protocol" members in
  let* dolphin = get Field.text "dolphin" members in
  let* purpose = get purpose "purpose" members in
  let* program = absent_text "program" members in
  let* resumes = get truth "resumes" members in
  Ok (Hello { version; dolphin; purpose; program; resumes })

let vehicles name members = get (list Line.word) name members

let start members =
  let* request = get Line.request "request" members in
  let* vehicle = get Line.word "vehicle" members in
  let* plan = get any "plan" members in
  let* timeout = get Line.seconds "timeout" members in
  Ok (request, vehicle, plan, timeout)

let check members =
  let* id = get Line.count "id" members in
  let* vehicle = absent_text "vehicle" members in
  let* plan = get any "plan" members in
  Ok (Check { id; vehicle; plan })

let kinds =
  [ ("hello", hello);
    ("telemetry", fun m -> let* on = get truth "on" m in Ok (Telemetry on));
    ("hold", fun m -> let* vs = vehicles "vehicles" m in Ok (Hold vs));
    ("release", fun m -> let* vs = vehicles "vehicles" m in Ok (Release vs));
    ( "timeout",
      fun m ->
        let* vs = optional (nullable (list Line.word)) ~default:None "vehicles" m in
        let* seconds = get Line.seconds "seconds" m in
        Ok (Timeout (vs, seconds)) );
    ("ping", fun m -> let* id = get Line.count "id" m in Ok (Ping id));
    ( "start",
      fun m ->
        let* request, vehicle, plan, timeout = start m in
        Ok (Start { request; vehicle; plan; timeout }) );
    ( "stop",
      fun m ->
        let* request = get Line.request "request" m in
        let* vehicle = get Line.word "vehicle" m in
        Ok (Stop { request; vehicle }) );
    ( "resume",
      fun m ->
        let* request, vehicle, plan, timeout = start m in
        let* notes = optional (list any) ~default:[] "notes" m in
        let* doubt = absent_text "doubt" m in
        (* Doubts of later versions are unknown. *)
        let doubt = Option.bind doubt (fun name -> List.assoc_opt name doubts) in
        Ok (Resume { request; vehicle; plan; timeout; notes; doubt }) );
    ("check", check);
    ("kept", fun m -> let* id = get Line.count "id" m in Ok (Kept id));
    ("refused", fun m -> let* why = get Field.text "why" m in Ok (Refused why));
    ("close", fun _ -> Ok Close) ]

let of_line text = Line.read kinds text
