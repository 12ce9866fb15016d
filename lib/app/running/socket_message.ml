open Dolphin_json
open Codec

type request =
  | Status
  | Follow
  | Stop
  | Post of { key : string; value : Yojson.Safe.t }
  | Replace of { program : string; set : (string * string) list option; hash : string option }

type code =
  | No_json
  | Bad_request
  | Unknown_request
  | Not_declared
  | Bad_value
  | No_journal
  | Ended
  | Too_many
  | Bad_program
  | Differs
  | Busy

type status = { program : string; time : float; inputs : string list; questions : string list }

type reply =
  | Done of float option
  | Status_is of status
  | Wrong of code * string

type 'a numbered = { id : Yojson.Safe.t option; content : 'a }

type line = Request of request numbered | Reply of reply numbered

(* {1 Requests} *)

let id () = optional "id" any (fun x -> x.id) ~doc:"any value; the reply has the same"

let path =
  let absolute text = if Filename.is_relative text then Error ("'" ^ text ^ "', not an absolute path") else Ok text in
  limited [ ("pattern", `String "^/") ] (conv absolute Fun.id text)

let status = constant "status" Status
let follow = constant "follow" Follow
let stop = constant "stop" Stop
let post = case "post" (one "key" text @& one "value" any) (fun (key, value) -> Post { key; value })

let replace =
  case "replace"
    (let+ program = field "program" path (fun (program, _, _) -> program)
     and+ set = optional "set" (map text) (fun (_, set, _) -> set) ~doc:"values of parameters"
     and+ hash = optional "hash" text (fun (_, _, hash) -> hash) ~doc:"the MD5 digest that the file must have" in
     (program, set, hash))
    (fun (program, set, hash) -> Replace { program; set; hash })

let requests = [ Case post; Case status; Case follow; Case replace; Case stop ]

let request =
  let choose = function
    | Status -> Is (status, ())
    | Follow -> Is (follow, ())
    | Stop -> Is (stop, ())
    | Post { key; value } -> Is (post, (key, value))
    | Replace { program; hash; set } -> Is (replace, (program, set, hash))
  in
  named "request"
    (record
       (let+ content = part (fun x -> x.content) (union ~tag:"request" requests choose)
        and+ id = id () in
        { id; content }))

(* {1 Replies} *)

let code =
  enum
    [ ("no-json", No_json); ("bad-request", Bad_request); ("unknown-request", Unknown_request);
      ("not-declared", Not_declared); ("bad-value", Bad_value); ("no-journal", No_journal); ("ended", Ended);
      ("too-many", Too_many); ("bad-program", Bad_program); ("differs", Differs); ("busy", Busy) ]

let version = 1
let moment = decimal ~least:0. ()

let done_ =
  limited [ ("not", `Assoc [ ("required", `List [ `String "protocol" ]) ]) ]
    (record
       (let+ id = id ()
        and+ () = fixed "ok" (`Bool true)
        and+ time = optional "time" moment (fun x -> x.content) in
        { id; content = time }))

let status_reply =
  record
    (let+ id = id ()
     and+ () = fixed "ok" (`Bool true)
     and+ () = fixed "protocol" (`String "dolphin-run")
     and+ () = fixed "version" (`Int version)
     and+ program = field "program" text (fun { content = s; _ } -> s.program) ~doc:"the path of the program"
     and+ time = field "time" moment (fun { content = s; _ } -> s.time) ~doc:"seconds since the start"
     and+ inputs = field "inputs" (list text) (fun { content = s; _ } -> s.inputs) ~doc:"the declared keys"
     and+ questions =
       field "questions" (list text) (fun { content = s; _ } -> s.questions) ~doc:"prompts of questions that stand" in
     { id; content = { program; time; inputs; questions } })

let wrong =
  record
    (let+ id = id ()
     and+ error = field "error" (record (one "code" code @& one "message" text)) (fun x -> x.content) in
     { id; content = error })

let done_ = form (named "done" done_) (fun x -> { x with content = Done x.content })
let status_reply = form (named "status" status_reply) (fun x -> { x with content = Status_is x.content })

let wrong =
  form (named "wrong" wrong) (fun { id; content = code, message } -> { id; content = Wrong (code, message) })

let reply =
  let recognise : json -> _ = function
    | `Assoc members when List.mem_assoc "error" members -> Form wrong
    | `Assoc members when List.mem_assoc "protocol" members -> Form status_reply
    | _ -> Form done_
  in
  let choose x =
    match x.content with
    | Done time -> As (done_, { x with content = time })
    | Status_is status -> As (status_reply, { x with content = status })
    | Wrong (code, message) -> As (wrong, { x with content = (code, message) })
  in
  either recognise choose [ Form done_; Form status_reply; Form wrong ]

(* {1 Lines} *)

let line =
  let request = form request (fun x -> Request x) and reply = form reply (fun x -> Reply x) in
  let recognise : json -> _ = function
    | `Assoc members when List.mem_assoc "request" members -> Form request
    | _ -> Form reply
  in
  let choose = function Request x -> As (request, x) | Reply x -> As (reply, x) in
  either recognise choose [ Form request; Form reply ]

let usage = "a request is an object with a request, as in {\"request\": \"status\"}"

let request_of_string line =
  match Host_value.parse line with
  | Error why -> Error { id = None; content = Wrong (No_json, "this is not JSON: " ^ why) }
  | Ok (`Assoc members) -> (
      let id = List.assoc_opt "id" members in
      let wrong code message = Error { id; content = Wrong (code, message) } in
      match List.assoc_opt "request" members with
      | Some (`String name) -> (
          match variant requests name with
          | None ->
            wrong Unknown_request
              (Printf.sprintf "unknown request '%s': the requests are post, status, follow, replace and stop" name)
          | Some read -> (
              match read members with
              | Ok content -> Ok { id; content }
              | Error why -> wrong Bad_request (Printf.sprintf "this is not a valid '%s': %s" name why)))
      | Some _ | None -> wrong Bad_request usage)
  | Ok _ -> Error { id = None; content = Wrong (Bad_request, usage) }
