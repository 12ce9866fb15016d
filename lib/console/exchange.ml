open Dolphin_app
open Dolphin_json
open Field
module Request = Dolphin_http.Request
module Response = Dolphin_http.Response

let ( let* ) = Result.bind

(* {1 Replies} *)

type json = Yojson.Safe.t

(* Why a request is not done: a status of HTTP, a code that does not change, a sentence, perhaps more. *)
type refusal = { status : int; code : string; message : string; more : members }

let refusal ?(more = []) status code message = { status; code; message; more }
let refuse ?more status code message = Error (refusal ?more status code message)
let bad message = refuse 400 "bad-request" message

let json ?(status = 200) (json : json) =
  Response.text ~kind:"application/json" status (Canonical.to_string json ^ "\n")

let of_refusal { status; code; message; more } =
  json ~status (`Assoc [ ("error", `Assoc ([ ("code", `String code); ("message", `String message) ] @ more)) ])

let of_result = function Ok found -> json found | Error r -> of_refusal r

(* {1 Arguments} *)

let needed result = Result.map_error (refusal 400 "bad-request") result

let body (r : Request.t) =
  match Host_value.parse r.body with
  | Ok (`Assoc found) -> Ok found
  | Ok _ -> bad "the body is no JSON object"
  | Error why -> bad ("the body is no JSON: " ^ why)

let get read name found = needed (get read name found)
let optional read name found = needed (Field.optional (nullable read) ~default:None name found)

let parameter r name =
  Option.to_result ~none:(refusal 400 "bad-request" ("the query lacks " ^ name)) (Request.parameter r name)

let folder h = (Hall.settings h).Hall.folder

let file h path = Result.map_error (refusal 404 "not-found") (Folder.find (folder h) path)

let of_error ~file ~source e =
  let message = match Error.sentences e with [] -> "the text has faults" | found -> String.concat "; " found in
  refusal ~more:[ ("diagnostics", Documents.of_error ~file ~source e) ] 422 "faults" message

let text path = Result.map_error (fun e -> refusal 404 "not-found" (String.concat "; " (Error.sentences e)))
    (Text_file.read path)

(* A program, with the text that its diagnostics speak of. *)
let program h ?(set = []) path =
  let* full = file h path in
  let* source = text full in
  Result.map_error (of_error ~file:full ~source) (Program_file.load ~set ~may_read:(Folder.may_read (folder h)) full)

(* That of the command line may lie anywhere; a file beside the program is none if it is a link to elsewhere. *)
let fleet_path h ~program named =
  let is_here path = Folder.may_read (folder h) path = Ok () in
  match named, (Hall.settings h).fleet with
  | Some path, _ | None, Some path -> Some path
  | None, None -> Option.bind (Fleet_file.choose ~program None) (fun path -> if is_here path then Some path else None)

let fleet h ~program named =
  let* named = match named with Some path -> Result.map Option.some (file h path) | None -> Ok None in
  let path = fleet_path h ~program named in
  let source = Option.fold path ~none:"" ~some:(fun path -> Result.value (Text_file.read path) ~default:"") in
  Result.map_error (of_error ~file:program ~source) (Fleet_file.load ~may_read:(Folder.may_read (folder h)) path)

let within fleet (p : Program_file.t) =
  Result.map_error (of_error ~file:p.path ~source:p.source) (Program_file.within fleet p)

(* The parameters that are set, each with the text of its value. *)
let set found =
  match List.assoc_opt "set" found with
  | None | Some `Null -> Ok []
  | Some json ->
    let* pairs = needed (members json) in
    let pair (name, json) = Result.map (fun value -> (name, value)) (needed (Field.text json)) in
    Dolphin_results.Results.map pair pairs
