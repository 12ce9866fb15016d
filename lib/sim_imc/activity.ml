type request = { plan : string; number : int; by : int; sent : float }

type t =
  | Started of { request : request; inline : bool; instead : string option }
  | Refused of { request : request; why : string; instead : string option }
  | Stopped of { request : request; plan : string option }
  | Ignored of { request : request; why : string }
  | Completed of request
  | Failed of { request : request; why : string }
  | Aborted of { by : int; plan : string option }
  | Blocked of { plan : string option }
  | Unblocked
  | Lost of { request : request }

let text s = `String s
let maybe key = function Some s -> [ (key, text s) ] | None -> []
let of_request r = [ ("plan", text r.plan); ("request_id", `Int r.number); ("by", `Int r.by); ("sent", `Float r.sent) ]
let command name r = ("command", text name) :: of_request r

let fields = function
  | Started { request; inline; instead } ->
    "started", command "START" request @ (("inline", `Bool inline) :: maybe "instead" instead)
  | Refused { request; why; instead } ->
    "refused", command "START" request @ (("why", text why) :: maybe "instead" instead)
  | Stopped { request; plan } -> "stopped", command "STOP" request @ maybe "stopped" plan
  | Ignored { request; why } -> "ignored", command "?" request @ [ ("why", text why) ]
  | Completed request -> "completed", of_request request
  | Failed { request; why } -> "failed", of_request request @ [ ("why", text why) ]
  | Aborted { by; plan } -> "aborted", ("by", `Int by) :: maybe "plan" plan
  | Blocked { plan } -> "blocked", maybe "plan" plan
  | Unblocked -> "unblocked", []
  | Lost { request } -> "lost", of_request request

let to_json ~time ~vehicle a =
  let did, fields = fields a in
  let time = Float.round (time *. 1e6) /. 1e6 in
  `Assoc (("time", `Float time) :: ("vehicle", text vehicle) :: ("did", text did) :: fields)
