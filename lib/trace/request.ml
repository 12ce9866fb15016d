open Dolphin_semantics
open Dolphin_json
open Field

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

let ending_members e : members =
  ("ending", `String e.how) :: (match e.message with None -> [] | Some text -> [ ("message", `String text) ])

let ending_of_members found =
  let* how' = get text "ending" found in
  let* message = optional (nullable text) ~default:None "message" found in
  if List.mem how' how then Ok { how = how'; message } else Error (Printf.sprintf "no run ends %S" how')

(* A timer may be infinite: JSON has no number for that. *)
let of_seconds seconds : Yojson.Safe.t = if Float.is_finite seconds then Canonical.number seconds else `Null

(* No finite time of a program is as long. *)
let seconds json =
  let* x = number json in
  if Float.abs x <= Time.longest then Ok x
  else Error (Printf.sprintf "%g, not a number of seconds up to %g" x Time.longest)

let to_seconds json = Result.map (Option.value ~default:infinity) (nullable seconds json)

let to_json r : Yojson.Safe.t =
  let one name text = [ (name, `String text) ] in
  `Assoc
    (match r with
     | Start { vehicle; plan } -> one "start" plan @ one "on" vehicle
     | Stop v -> one "stop" v
     | Set_timer { timer; seconds } -> [ ("set-timer", `Int timer); ("seconds", of_seconds seconds) ]
     | Cancel_timer timer -> [ ("cancel-timer", `Int timer) ]
     | Put_question { question; prompt } -> [ ("put-question", `Int question); ("prompt", `String prompt) ]
     | Withdraw_question question -> [ ("withdraw-question", `Int question) ]
     | Look_for what -> one "look-for" what
     | Bind vs -> [ ("bind", texts vs) ]
     | Release vs -> [ ("release", texts vs) ]
     | Set_connection_timeout { vehicles; seconds } ->
       [ ("connection-timeout", of_seconds seconds); ("of", of_option texts vehicles) ]
     | Say text -> one "say" text
     | Ask prompt -> one "ask" prompt
     | Call what -> one "call" what
     | End e -> [ ("end", `Assoc (ending_members e)) ])

let of_json json =
  let* found = members json in
  let one name make = Result.map make (get text name found) in
  match found with
  | ("start", _) :: _ ->
    let* plan = get text "start" found in
    let* vehicle = get text "on" found in
    Ok (Start { vehicle; plan })
  | ("stop", _) :: _ -> one "stop" (fun v -> Stop v)
  | ("set-timer", _) :: _ ->
    let* timer = get whole "set-timer" found in
    let* seconds = get to_seconds "seconds" found in
    Ok (Set_timer { timer; seconds })
  | ("cancel-timer", _) :: _ -> Result.map (fun timer -> Cancel_timer timer) (get whole "cancel-timer" found)
  | ("put-question", _) :: _ ->
    let* question = get whole "put-question" found in
    Result.map (fun prompt -> Put_question { question; prompt }) (get text "prompt" found)
  | ("withdraw-question", _) :: _ ->
    Result.map (fun question -> Withdraw_question question) (get whole "withdraw-question" found)
  | ("look-for", _) :: _ -> one "look-for" (fun what -> Look_for what)
  | ("bind", _) :: _ -> Result.map (fun vs -> Bind vs) (get (list text) "bind" found)
  | ("release", _) :: _ -> Result.map (fun vs -> Release vs) (get (list text) "release" found)
  | ("connection-timeout", _) :: _ ->
    let* seconds = get to_seconds "connection-timeout" found in
    let* vehicles = get (nullable (list text)) "of" found in
    Ok (Set_connection_timeout { vehicles; seconds })
  | ("say", _) :: _ -> one "say" (fun text -> Say text)
  | ("ask", _) :: _ -> one "ask" (fun prompt -> Ask prompt)
  | ("call", _) :: _ -> one "call" (fun what -> Call what)
  | ("end", _) :: _ ->
    let* ending = get members "end" found in
    Result.map (fun e -> End e) (ending_of_members ending)
  | _ -> Error (Printf.sprintf "%s asks for nothing that is known" (Canonical.to_string json))
