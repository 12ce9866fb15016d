open Dolphin_semantics
open Dolphin_json
open Field

type t =
  | Done of string
  | Failed of { vehicle : string; why : string }
  | Timer of int
  | Confirmation of { question : int; yes : bool }
  | No_confirmation of { question : int; why : string }
  | Recruited of { recruit : int; vehicle : string }
  | Answer of string
  | No_answer of string
  | Reply of Yojson.Safe.t
  | No_reply of string
  | Input of { key : string; value : Yojson.Safe.t }
  | Interruption of { stuck : bool }

let json_of x =
  match Host_value.to_json x with Ok json -> json | Error why -> invalid_arg ("Event.of_event: " ^ why)

let of_event ?(stuck = false) : Transition.event -> t = function
  | Vehicle_done v -> Done v
  | Vehicle_failed (vehicle, why) -> Failed { vehicle; why }
  | Timer_expired timer -> Timer timer
  | Confirmed (question, Ok yes) -> Confirmation { question; yes }
  | Confirmed (question, Error why) -> No_confirmation { question; why }
  | Recruited (recruit, vehicle) -> Recruited { recruit; vehicle }
  | Answered { text; _ } -> Answer text
  | Nobody_answers why -> No_answer why
  | Replied x -> Reply (json_of x)
  | Host_failed why -> No_reply why
  | Input (key, x) -> Input { key; value = json_of x }
  | Interruption -> Interruption { stuck }

type fault = No_value of string | Refused of Transition.refusal

let answer program (c : Configuration.t) text =
  match c.control with
  | Waiting (_, Ask _) -> Result.map_error (fun why -> Refused why) (Answer.event program text)
  | Waiting (_, (Pick _ | Pause _ | Execute _ | Host_call _)) | Script _ | Executing _ | Ended _ ->
    Error (Refused Not_awaited)

let to_event program c : t -> (Transition.event, fault) result = function
  | Done v -> Ok (Vehicle_done v)
  | Failed { vehicle; why } -> Ok (Vehicle_failed (vehicle, why))
  | Timer timer -> Ok (Timer_expired timer)
  | Confirmation { question; yes } -> Ok (Confirmed (question, Ok yes))
  | No_confirmation { question; why } -> Ok (Confirmed (question, Error why))
  | Recruited { recruit; vehicle } -> Ok (Recruited (recruit, vehicle))
  | Answer text -> answer program c text
  | No_answer why -> Ok (Nobody_answers why)
  | Reply json -> (
      match Host_value.of_json ~site:(Configuration.site c) json with
      | Ok x -> Ok (Replied x)
      | Error why -> Error (No_value why))
  | No_reply why -> Ok (Host_failed why)
  | Input { key; value } -> (
      match Host_value.data_of_json value with
      | Ok x -> Ok (Input (key, x))
      | Error why -> Error (No_value why))
  | Interruption _ -> Ok Interruption

let members h : members =
  let event name rest = ("event", `String name) :: rest in
  match h with
  | Done v -> event "done" [ ("vehicle", `String v) ]
  | Failed { vehicle; why } -> event "failed" [ ("vehicle", `String vehicle); ("why", `String why) ]
  | Timer timer -> event "timer" [ ("timer", `Int timer) ]
  | Confirmation { question; yes } -> event "confirmation" [ ("question", `Int question); ("yes", `Bool yes) ]
  | No_confirmation { question; why } ->
    event "no-confirmation" [ ("question", `Int question); ("why", `String why) ]
  | Recruited { recruit; vehicle } -> event "recruited" [ ("recruit", `Int recruit); ("vehicle", `String vehicle) ]
  | Answer text -> event "answer" [ ("text", `String text) ]
  | No_answer why -> event "no-answer" [ ("why", `String why) ]
  | Reply json -> event "reply" [ ("value", json) ]
  | No_reply why -> event "no-reply" [ ("why", `String why) ]
  | Input { key; value } -> event "input" [ ("key", `String key); ("value", value) ]
  | Interruption { stuck } -> event "interruption" (if stuck then [ ("stuck", `Bool true) ] else [])

let of_members found =
  let* event = get text "event" found in
  match event with
  | "done" -> Result.map (fun v -> Done v) (get text "vehicle" found)
  | "failed" ->
    let* vehicle = get text "vehicle" found in
    let* why = get text "why" found in
    Ok (Failed { vehicle; why })
  | "timer" -> Result.map (fun timer -> Timer timer) (get whole "timer" found)
  | "confirmation" ->
    let* question = get whole "question" found in
    Result.map (fun yes -> Confirmation { question; yes }) (get truth "yes" found)
  | "no-confirmation" ->
    let* question = get whole "question" found in
    Result.map (fun why -> No_confirmation { question; why }) (get text "why" found)
  | "recruited" ->
    let* recruit = get whole "recruit" found in
    Result.map (fun vehicle -> Recruited { recruit; vehicle }) (get text "vehicle" found)
  | "answer" -> Result.map (fun text -> Answer text) (get text "text" found)
  | "no-answer" -> Result.map (fun why -> No_answer why) (get text "why" found)
  | "reply" -> Result.map (fun json -> Reply json) (get any "value" found)
  | "no-reply" -> Result.map (fun why -> No_reply why) (get text "why" found)
  | "input" ->
    let* key = get text "key" found in
    let* value = get any "value" found in
    Ok (Input { key; value })
  | "interruption" -> Result.map (fun stuck -> Interruption { stuck }) (optional truth ~default:false "stuck" found)
  | other -> Error (Printf.sprintf "unknown kind of event: %S" other)

let pp ppf h =
  let print format = Format.fprintf ppf format in
  match h with
  | Done v -> print "the end of %s's task" v
  | Failed { vehicle; why } -> print "the failure of %s's task (%s)" vehicle why
  | Timer 0 -> print "the end of the script's pause or pick"
  | Timer timer -> print "the end of timer %d" timer
  | Confirmation { yes; _ } -> print "the answer %s" (if yes then "yes" else "no")
  | No_confirmation _ -> print "no answer"
  | Recruited { vehicle; _ } -> print "the coming of %s" vehicle
  | Answer text -> print "the answer %s" text
  | No_answer _ -> print "no answer"
  | Reply json -> print "the host's reply %s" (Canonical.to_string json)
  | No_reply _ -> print "no reply of the host"
  | Input { key; value } -> print "the input %s: %s" key (Canonical.to_string value)
  | Interruption { stuck = false } -> print "an interruption"
  | Interruption { stuck = true } -> print "the interruption of a program that is stuck"
