open Dolphin_semantics
open Dolphin_json
open Field

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

(* {1 Writing} *)

let text = Line.text
let of_number x : Yojson.Safe.t = `Float x
let member name write = function Some x -> [ (name, write x) ] | None -> []

let of_greeting g =
  [ ("protocol", `Int g.version); ("name", text g.name) ]
  @ member "version" text g.adapter
  @ [ ("plans", texts g.plans); ("announce", of_number g.announce); ("patience", of_number g.patience) ]

let of_sight s =
  (("vehicle", text s.vehicle) :: member "type" text s.kind)
  @ member "payload" texts s.payload
  @ (match s.place with
      | Some (latitude, longitude) -> [ ("latitude", of_number latitude); ("longitude", of_number longitude) ]
      | None -> [])
  @ member "height" of_number s.height
  @ member "depth" (of_option of_number) s.depth
  @ member "altitude" (of_option of_number) s.altitude
  @ member "battery" (of_option of_number) s.battery
  @ member "speed" (of_option of_number) s.speed
  @ (if s.readings = [] then []
     else [ ("readings", `Assoc (List.map (fun (name, x) -> (name, of_option of_number x)) s.readings)) ])
  @ member "link" (fun b -> `Bool b) s.link
  @ member "unready" (of_option text) s.unready

let of_word request word =
  let line kind members = Line.make kind (("request", text request) :: members) in
  match word with
  | Taken -> line "taken" []
  | Progress { share; remaining } ->
    line "progress" (member "share" of_number share @ member "remaining" of_number remaining)
  | Done -> line "done" []
  | Failed why -> line "failed" [ ("why", text why) ]
  | Stopped -> line "stopped" []
  | Unknown why -> line "unknown" [ ("why", text why) ]
  | Absent -> line "absent" []

let to_json = function
  | Hello g -> Line.make "hello" (of_greeting g)
  | Trouble why -> Line.make "error" [ ("why", text why) ]
  | Vehicle s -> Line.make "vehicle" (of_sight s)
  | Gone vehicle -> Line.make "gone" [ ("vehicle", text vehicle) ]
  | Pong id -> Line.make "pong" [ ("id", `Int id) ]
  | Request (request, word) -> of_word request word
  | Checked { id; problems } -> Line.make "checked" [ ("id", `Int id); ("problems", texts problems) ]
  | Note { request; note; id } ->
    Line.make "note" ([ ("request", text request); ("note", note) ] @ member "id" (fun id -> `Int id) id)
  | Log { vehicle; text = words } -> Line.make "log" (member "vehicle" text vehicle @ [ ("text", text words) ])
  | Quiet -> Line.make "quiet" []

let to_line report = Canonical.to_string (to_json report) ^ "\n"

(* {1 Reading} *)

(* [null] counts as absent. *)
let absent read = optional (nullable read) ~default:None

(* [null] is a value of its own. *)
let as_before read name members =
  match List.assoc_opt name members with
  | None -> Ok None
  | Some _ -> Result.map Option.some (get (nullable read) name members)

let between least most json =
  let* x = number json in
  if x >= least && x <= most then Ok x else Error (Printf.sprintf "%g, not a number from %g to %g" x least most)

let platform_name json =
  let* name = Line.word json in
  let fits = function 'A' .. 'Z' | 'a' .. 'z' | '0' .. '9' | '-' | '_' -> true | _ -> false in
  if String.for_all fits name then Ok name
  else Error (Printf.sprintf "'%s', not a name of letters, digits, '-' and '_'" name)

let greeting members =
  let* version = get Line.count "protocol" members in
  let* name = get platform_name "name" members in
  let* adapter = absent Field.text "version" members in
  let* plans = optional (list Line.word) ~default:[ "name" ] "plans" members in
  let* announce = optional Line.seconds ~default:10. "announce" members in
  let* patience = optional Line.seconds ~default:30. "patience" members in
  Ok (Hello { version; name; adapter; plans; announce; patience })

let place members =
  let* latitude = absent (between (-90.) 90.) "latitude" members in
  let* longitude = absent (between (-180.) 180.) "longitude" members in
  match latitude, longitude with
  | Some latitude, Some longitude -> Ok (Some (latitude, longitude))
  | None, None -> Ok None
  | Some _, None | None, Some _ -> Error "of latitude and longitude one is missing"

let readings json =
  let* found = Field.members json in
  let reading (name, json) =
    Result.map_error (Printf.sprintf "%s: %s" name) (Result.map (fun x -> (name, x)) (nullable number json))
  in
  Dolphin_results.Results.map reading found

let sight members =
  let* vehicle = get Line.word "vehicle" members in
  let* kind = absent Line.word "type" members in
  let* payload = absent (list Field.text) "payload" members in
  let* place = place members in
  let* height = absent number "height" members in
  let* depth = as_before number "depth" members in
  let* altitude = as_before number "altitude" members in
  let* battery = as_before (between 0. 1.) "battery" members in
  let* speed = as_before Line.seconds "speed" members in
  let* readings = optional (fun json -> if json = `Null then Ok [] else readings json) ~default:[] "readings" members in
  let* link = absent truth "link" members in
  let* unready = as_before Line.word "unready" members in
  Ok (Vehicle { vehicle; kind; payload; place; height; depth; altitude; battery; speed; readings; link; unready })

let word make members =
  let* request = get Line.request "request" members in
  let* word = make members in
  Ok (Request (request, word))

let progress members =
  let* share = absent (between 0. 1.) "share" members in
  let* remaining = absent Line.seconds "remaining" members in
  Ok (Progress { share; remaining })

let because make members = Result.map make (get Line.word "why" members)

let note members =
  let* request = get Line.request "request" members in
  let* note = get Field.members "note" members in
  let* id = absent Line.count "id" members in
  Ok (Note { request; note = `Assoc note; id })

let checked members =
  let* id = get Line.count "id" members in
  let* problems = get (list Line.word) "problems" members in
  Ok (Checked { id; problems })

let log members =
  let* vehicle = absent Line.word "vehicle" members in
  let* text = get Field.text "text" members in
  Ok (Log { vehicle; text })

let simply x _ = Ok x

let kinds =
  [ ("hello", greeting);
    ("error", because (fun why -> Trouble why));
    ("vehicle", sight);
    ("gone", fun m -> Result.map (fun v -> Gone v) (get Line.word "vehicle" m));
    ("pong", fun m -> Result.map (fun id -> Pong id) (get Line.count "id" m));
    ("taken", word (simply Taken));
    ("progress", word progress);
    ("done", word (simply Done));
    ("failed", word (because (fun why -> Failed why)));
    ("stopped", word (simply Stopped));
    ("unknown", word (because (fun why -> Unknown why)));
    ("absent", word (simply Absent));
    ("checked", checked);
    ("note", note);
    ("log", log);
    ("quiet", simply Quiet) ]

let of_line text = Line.read kinds text
let version = Line.version
let longest_line = Line.longest
