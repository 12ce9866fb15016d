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
  | Ok _ -> bad "the body is not a JSON object"
  | Error why -> bad ("the body is not JSON: " ^ why)

let get read name found = needed (get read name found)
let optional read name found = needed (Field.optional (nullable read) ~default:None name found)

let parameter r name =
  Option.to_result ~none:(refusal 400 "bad-request" ("the query lacks " ^ name)) (Request.parameter r name)

(* The parameters that are set, each with the text of its value. *)
let set found =
  match List.assoc_opt "set" found with
  | None | Some `Null -> Ok []
  | Some json ->
    let* pairs = needed (members json) in
    let pair (name, json) = Result.map (fun value -> (name, value)) (needed (Field.text json)) in
    Dolphin_results.Results.map pair pairs
