open Dolphin_semantics
open Dolphin_json
open Codec

type ending = { how : string; message : string option }

type t =
  | Start of { vehicle : string; plan : string }
  | Stop of string
  | Set_timer of { timer : int; seconds : float }
  | Cancel_timer of int
  | Put_question of { question : int; prompt : string }
  | Withdraw_question of int
  | Look_for of string
  | Bind of string list
  | Release of string list
  | Set_connection_timeout of { vehicles : string list option; seconds : float }
  | Say of string
  | Ask of string
  | Call of string
  | End of ending

let how = [ "completed"; "halted"; "failed"; "interrupted"; "stuck" ]

let ending : Configuration.ending -> ending = function
  | Completed -> { how = "completed"; message = None }
  | Halted message -> { how = "halted"; message = Some message }
  | Failed fault -> { how = "failed"; message = Some fault.message }
  | Interrupted -> { how = "interrupted"; message = None }

let of_effect : Effect.t -> t = function
  | Start (vehicle, p) -> Start { vehicle; plan = p.name }
  | Stop v -> Stop v
  | Set_timer (timer, seconds) -> Set_timer { timer; seconds }
  | Cancel_timer timer -> Cancel_timer timer
  | Put_question (question, prompt) -> Put_question { question; prompt }
  | Withdraw_question question -> Withdraw_question question
  | Look_for pick -> Look_for (Format.asprintf "%a" Settings.pp_pick pick)
  | Bind vs -> Bind vs
  | Release vs -> Release vs
  | Set_connection_timeout (vehicles, seconds) -> Set_connection_timeout { vehicles; seconds }
  | Say text -> Say text
  | Ask prompt -> Ask prompt
  | Call_host { subject; member; _ } -> Call (Machine.name_of_call ~subject ~member)
  | End e -> End (ending e)

(* {1 JSON} *)

let ending_fields =
  let+ how = field "ending" (enum (List.map (fun name -> (name, name)) how)) (fun (e : ending) -> e.how)
  and+ message = optional "message" text (fun (e : ending) -> e.message) ~null:true in
  { how; message }

let ending_members = Codec.members ending_fields

(* A timer may be infinite: JSON has no number for that. No finite time of a program is as long as the limit. *)
let seconds =
  conv
    (fun x -> Ok (Option.value x ~default:infinity))
    (fun x -> if Float.is_finite x then Some x else None)
    (nullable (number ~least:(-.Time.longest) ~most:Time.longest ()))

(* Lists that are written have an element. *)
let some_texts = named "some-texts" (limited [ ("minItems", `Int 1) ] (list text))

let start = case "start" (one "start" text @& one "on" text) (fun (plan, vehicle) -> Start { vehicle; plan })
let stop = case "stop" (one "stop" text) (fun v -> Stop v)

let set_timer =
  case "set-timer" (one "set-timer" count @& one "seconds" seconds) (fun (timer, seconds) ->
      Set_timer { timer; seconds })

let cancel_timer = case "cancel-timer" (one "cancel-timer" count) (fun timer -> Cancel_timer timer)

let put_question =
  case "put-question" (one "put-question" count @& one "prompt" text) (fun (question, prompt) ->
      Put_question { question; prompt })

let withdraw_question =
  case "withdraw-question" (one "withdraw-question" count) (fun question -> Withdraw_question question)

let look_for = case "look-for" (one "look-for" text) (fun what -> Look_for what)
let bind = case "bind" (one "bind" some_texts) (fun vs -> Bind vs)
let release = case "release" (one "release" (list text)) (fun vs -> Release vs)

let connection_timeout =
  case "connection-timeout"
    (one "connection-timeout" seconds @& one "of" (nullable (list text)) ~doc:"null: all vehicles")
    (fun (seconds, vehicles) -> Set_connection_timeout { vehicles; seconds })

let say = case "say" (one "say" text) (fun text -> Say text)
let ask = case "ask" (one "ask" text) (fun prompt -> Ask prompt)
let call = case "call" (one "call" text) (fun what -> Call what)
let end_ = case "end" (one "end" (record ending_fields)) (fun e -> End e)

let codec =
  let choose = function
    | Start { vehicle; plan } -> Is (start, (plan, vehicle))
    | Stop v -> Is (stop, v)
    | Set_timer { timer; seconds } -> Is (set_timer, (timer, seconds))
    | Cancel_timer timer -> Is (cancel_timer, timer)
    | Put_question { question; prompt } -> Is (put_question, (question, prompt))
    | Withdraw_question question -> Is (withdraw_question, question)
    | Look_for what -> Is (look_for, what)
    | Bind vs -> Is (bind, vs)
    | Release vs -> Is (release, vs)
    | Set_connection_timeout { vehicles; seconds } -> Is (connection_timeout, (seconds, vehicles))
    | Say text -> Is (say, text)
    | Ask prompt -> Is (ask, prompt)
    | Call what -> Is (call, what)
    | End e -> Is (end_, e)
  in
  named "effect"
    (keyed
       [ Case start; Case stop; Case set_timer; Case cancel_timer; Case put_question; Case withdraw_question;
         Case look_for; Case bind; Case release; Case connection_timeout; Case say; Case ask; Case call; Case end_ ]
       choose)
