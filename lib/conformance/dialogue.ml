open Dolphin_json.Field

type json = Yojson.Safe.t

exception Trouble of string

type ask = json -> (json, string) result
type place = { configuration : json; world : json; now : int }
type transition = { event : json option; label : string; rules : string list; effects : json list; next : json }
type steps = { internal : transition list; caused : transition list; awaited : json list; refused : string list }

let trouble format = Printf.ksprintf (fun why -> raise (Trouble why)) format

(* {1 Replies} *)

let read what result =
  match result with Ok x -> x | Error why -> trouble "the reply to %s is not what the protocol has: %s" what why

let error found =
  let* error = get members "error" found in
  let* code = get text "code" error in
  let* message = optional text ~default:"" "message" error in
  Ok (code, message)

let request (ask : ask) what parts =
  match ask (`Assoc (("request", `String what) :: parts)) with
  | Error why -> trouble "%s" why
  | Ok reply -> (
      let found = read what (members reply) in
      match List.mem_assoc "error" found with
      | false -> found
      | true ->
        let code, message = read what (error found) in
        trouble "the reply to %s is the error %s: %s" what code message)

let hello ask =
  let found = request ask "hello" [] in
  let text name = read "hello" (get text name found) in
  if text "protocol" <> "dolphin-step" then trouble "this speaks %S, not \"dolphin-step\"" (text "protocol");
  let version = read "hello" (get whole "version" found) in
  if version <> Oracle.version then
    trouble "this speaks version %d of the protocol; version %d is known here" version Oracle.version;
  text "implementation"

let rejection json =
  let* found = members json in
  let* code = get text "code" found in
  let* line = optional (nullable whole) ~default:None "line" found in
  Ok (code, line)

let initial ask ~program ~fleet =
  let found = request ask "initial" [ ("program", `String program); ("fleet", `String fleet) ] in
  match List.assoc_opt "rejected" found with
  | Some json -> Error (List.sort compare (read "initial" (list rejection json)))
  | None ->
    let part name = read "initial" (get any name found) in
    Ok { configuration = part "configuration"; world = part "world"; now = 0 }

let transition json =
  let* found = members json in
  let* event = optional (fun json -> Ok (Some json)) ~default:None "event" found in
  let* label = get text "label" found in
  let* rules = get (list text) "rule" found in
  let* effects = optional (list any) ~default:[] "effects" found in
  let* next = get any "next" found in
  Ok { event; label; rules; effects; next }

let refusal json =
  let* found = members json in
  get text "code" found

let steps ask place events =
  let events = match events with None -> [] | Some events -> [ ("events", `List events) ] in
  let now = if place.now = 0 then [] else [ ("now", `Int place.now) ] in
  let place = [ ("configuration", place.configuration); ("world", place.world) ] in
  let found = request ask "step" (place @ now @ events) in
  let transitions = read "step" (get (list transition) "transitions" found) in
  let internal, caused = List.partition (fun t -> t.event = None) transitions in
  { internal; caused;
    awaited = read "step" (get (list any) "awaited" found);
    refused = read "step" (optional (list refusal) ~default:[] "refused" found) }

let with_faults faults parts = match faults with "" -> parts | text -> ("faults", `String text) :: parts
let times ask ~faults = read "times" (Timed_data.times (request ask "times" (with_faults faults [])))

let dated ask ~faults run =
  let event (at, event) = `Assoc [ ("at", `Int at); ("event", event) ] in
  let found = request ask "dated" (with_faults faults [ ("run", `List (List.map event run)) ]) in
  read "dated" (get Timed_data.findings "findings" found)

(* {1 Configurations} *)

let show what reader configuration =
  let found = read "step" (members configuration) in
  read "step" (get reader what found)

let named json =
  let* found = members json in
  let texts = List.map (fun (name, json) -> Result.map (fun x -> (name, x)) (text json)) found in
  match List.find_map (function Error why -> Some why | Ok _ -> None) texts with
  | Some why -> Error why
  | None -> Ok (List.sort compare (List.filter_map Result.to_option texts))

let to_ending json =
  let* found = members json in
  let* how = get text "ending" found in
  let* message = optional (nullable text) ~default:None "message" found in
  Ok (how, message)

let ending = show "end" (nullable to_ending)
let running = show "A" named
let bound = show "B" (list text)
let pairs configuration = List.sort compare (show "N" (list text) configuration)
let store = show "store" named
let key configuration = Dolphin_json.Canonical.to_string (Yojson.Safe.sort configuration)
