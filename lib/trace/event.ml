open Dolphin_semantics
open Dolphin_json
open Codec

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

let vehicle = one "vehicle" text
let why = one "why" text
let done_ = case "done" vehicle (fun v -> Done v)
let failed = case "failed" (vehicle @& why) (fun (vehicle, why) -> Failed { vehicle; why })
let timer = case "timer" (one "timer" count) (fun timer -> Timer timer)
let question = one "question" count

let confirmation =
  case "confirmation" (question @& one "yes" truth) (fun (question, yes) -> Confirmation { question; yes })

let no_confirmation =
  case "no-confirmation" (question @& why) (fun (question, why) -> No_confirmation { question; why })

let recruited =
  case "recruited" (one "recruit" count @& vehicle) (fun (recruit, vehicle) -> Recruited { recruit; vehicle })

let an_answer = case "answer" (one "text" text) (fun text -> Answer text)
let no_answer = case "no-answer" why (fun why -> No_answer why)
let reply = case "reply" (one "value" any) (fun json -> Reply json)
let no_reply = case "no-reply" why (fun why -> No_reply why)
let input = case "input" (one "key" text @& one "value" any) (fun (key, value) -> Input { key; value })

(* The member is written if it is true. *)
let interruption =
  let stuck = default false "stuck" (limited [ ("const", `Bool true) ] truth) Fun.id in
  case "interruption" stuck (fun stuck -> Interruption { stuck })

let fields =
  let choose = function
    | Done v -> Is (done_, v)
    | Failed { vehicle; why } -> Is (failed, (vehicle, why))
    | Timer i -> Is (timer, i)
    | Confirmation { question; yes } -> Is (confirmation, (question, yes))
    | No_confirmation { question; why } -> Is (no_confirmation, (question, why))
    | Recruited { recruit; vehicle } -> Is (recruited, (recruit, vehicle))
    | Answer text -> Is (an_answer, text)
    | No_answer why -> Is (no_answer, why)
    | Reply json -> Is (reply, json)
    | No_reply why -> Is (no_reply, why)
    | Input { key; value } -> Is (input, (key, value))
    | Interruption { stuck } -> Is (interruption, stuck)
  in
  union ~tag:"event"
    [ Case done_; Case failed; Case timer; Case confirmation; Case no_confirmation; Case recruited; Case an_answer;
      Case no_answer; Case reply; Case no_reply; Case input; Case interruption ]
    choose

let members = Codec.members fields
let of_members = Codec.of_members fields

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
