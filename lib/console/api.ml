open Dolphin_json
open Field
open Lwt.Infix
open Exchange
module Request = Dolphin_http.Request
module Response = Dolphin_http.Response

(* {1 The helm} *)

let client h role (r : Request.t) =
  let operator = Access.operator (Session.access h) r in
  let key =
    match Request.header r "x-dolphin-client", Request.parameter r "client" with
    | Some key, _ | None, Some key -> key
    | None, None -> "api"
  in
  if Visitors.is_key key then Ok (Session.name h ?operator role key)
  else bad "a client's key has 1 to 64 letters, digits, points, dashes and underscores"

let take h client by =
  if not (Session.watches h client) then
    refuse 409 "not-watching" "a client that has the helm looks on: GET /api/events?client=KEY"
  else Ok (Session.set_helm h (by (Session.helm h) client))

(* The log shows it to all clients. *)
let force h client =
  let before = Helm.holder (Session.helm h) in
  let* () = take h client Helm.force in
  match Session.run h, before with
  | Some run, Some other when other <> client && Live_run.goes_on run && Session.operator h client = None ->
    Ok (Live_run.remark run (Printf.sprintf "%s takes the helm from %s" client other))
  | (Some _ | None), _ -> Ok ()

let steer h client found =
  let* what = get Field.text "want" found in
  match what with
  | "take" -> take h client Helm.ask
  | "force" -> force h client
  | "keep" -> Ok (Session.keep_helm h client)
  | "give-up" -> Ok (Session.set_helm h (Helm.give_up (Session.helm h) client))
  | _ -> bad "want is \"take\", \"force\", \"keep\" or \"give-up\""

let helm h client found =
  let* () = steer h client found in
  let helm = Session.helm h in
  Ok (`Assoc [ ("holder", of_option (fun c -> `String c) (Helm.holder helm)); ("asking", texts (Helm.asking helm)) ])

(* {1 Operators} *)

let administers h client =
  if Session.is_admin h client then Ok () else refuse 403 "not-admin" "this needs the role admin"

let operators h role r =
  let listed =
    let* client = client h role r in
    Result.map (fun () -> json (Session.operators h)) (administers h client)
  in
  Lwt.return listed

let shut_out h client found =
  let* () = administers h client in
  let* name = get Field.text "shut_out" found in
  let* () = Result.map_error (refusal 404 "not-found") (Session.shut_out h client name) in
  Ok (Session.operators h)

(* {1 Routes} *)

type route =
  | Look of (Session.t -> Response.t)
  | Beside of string  (* a task of a worker *)
  | Save of string  (* likewise, of the client that has the helm *)
  | Told of (Session.t -> Access.role -> Request.t -> (Response.t, refusal) result Lwt.t)
  | Command of (Session.t -> Field.members -> (json, refusal) result)
  | Answer of (Session.t -> string -> Field.members -> (json, refusal) result Lwt.t)  (* of clients that answer, too *)
  | Later of (Session.t -> client:string -> Request.t -> Field.members -> (json, Response.t) result Lwt.t)
  | Steer of (Session.t -> string -> Field.members -> (json, refusal) result)

let most_watchers = 60
let most_steerers = 40
let most_of_one = 6

let role_event h (role : Access.role) client =
  let of_operator (o : Operators.operator) : Yojson.Safe.t =
    `Assoc [ ("name", of_option (fun name -> `String name) o.name); ("admin", `Bool o.admin);
             ("duties", texts o.duties) ]
  in
  let operator = of_option of_operator (Session.record_of h client) in
  let json = `Assoc [ ("role", `String (Operators.role_name role)); ("client", `String client);
                      ("operator", operator) ] in
  Printf.sprintf "event: role\ndata: %s\n\n" (Canonical.to_string json)

let events h (role : Access.role) r =
  let* client = client h role r in
  let most = match role with Steers | Answers -> most_steerers | Watches -> most_watchers in
  if Session.watchers h role >= most then refuse 503 "too-many" "too many look on"
  else if Session.streams_of h client >= most_of_one then refuse 503 "too-many" "this client looks on often enough"
  else
    let last = match Request.header r "last-event-id" with Some id -> Some id | None -> Request.parameter r "last" in
    let follow write = write (role_event h role client) >>= fun () -> Session.follow h role ~client ~last write in
    Ok (Response.stream ~kind:"text/event-stream" follow)

(* {1 Work in other processes} *)

let order h ?(query = []) task = { Worker.task; workspace = Session.workspace h; query }

let beside h role ~client task (r : Request.t) =
  Worker_pool.whole (Session.workers h role) ~client (order h ~query:r.query task) ~body:r.body () >|= function
  | Ok response -> response
  | Error r -> of_refusal r

let failed_event (r : refusal) =
  Printf.sprintf "event: failed\ndata: %s\n\n" (Canonical.to_string (`Assoc [ ("message", `String r.message) ]))

(* Only the first line of the journal is read before the reply begins. *)
let replay h role (r : Request.t) =
  let too_many = refusal 503 "too-many" "too many replays are under way" in
  match client h role r with
  | Error r -> Lwt.return (Error r)
  | Ok client ->
    let journal () = Worker_pool.whole (Session.workers h role) ~client (order h ~query:r.query "journal") () in
    if Worker_pool.is_full (Session.replays h role) client then Lwt.return (Error too_many)
    else
      journal () >|= function
      | Error r -> Error r
      | Ok { Response.status = 200; body = Text text; _ } ->
        let* json = needed (Host_value.parse text) in
        let* found = needed (Field.members json) in
        let* journal = get Field.text "journal" found in
        let order = order h ~query:[ ("journal", journal) ] "replay" in
        let write_all write =
          Worker_pool.pieces (Session.replays h role) ~client order write >>= function
          | Ok () -> Lwt.return_unit
          | Error r -> write (failed_event r)
        in
        Ok (Response.stream ~kind:"text/event-stream" write_all)
      | Ok response -> Ok response

let differences h role (r : Request.t) =
  match
    let* client = client h role r in
    Result.map (fun found -> (client, found)) (body r)
  with
  | Error r -> Lwt.return (Error r)
  | Ok (client, found) ->
    Run_commands.differences h role ~client found
    >|= (function Ok found -> Ok (json (`Assoc found)) | Error response -> Ok response)

let plans h role (r : Request.t) =
  match client h role r with
  | Error r -> Lwt.return (Error r)
  | Ok client -> (
      Run_commands.prepared h role ~client "plans" r.body >>= function
      | Error response -> Lwt.return (Ok response)
      | Ok found ->
        Plans.list ~dolphin:(Session.settings h).dolphin found
        >|= Result.map (Response.text ~kind:"application/json" 200))

let watcher = refusal 403 "watches" "this link is for watching: it commands nothing"

(* The helm is for the run that goes on; notes are on others. *)
let note h role (r : Request.t) =
  match
    let* () = if role = Access.Watches then Error watcher else Ok () in
    let* client = client h role r in
    Result.map (fun found -> (client, found)) (body r)
  with
  | Error r -> Lwt.return (Error r)
  | Ok (client, found) ->
    let by = of_option (fun (o : Live_run.operator) -> `String o.name) (Session.operator h client) in
    let found = ("by", by) :: List.remove_assoc "by" found in
    Run_commands.prepared h role ~client "note" (Canonical.to_string (`Assoc found))
    >|= (function Ok found -> Ok (json (`Assoc found)) | Error response -> Ok response)

let analyse (subject : Analysis.subject) h ~client (r : Request.t) _ =
  let start found = Result.map_error of_refusal (Analyses.start subject h found) in
  match Analyses.not_busy subject h with
  | Error r -> Lwt.return (Error (of_refusal r))
  | Ok () ->
    Run_commands.prepared h Steers ~client (Analysis.subject_name subject) r.body >|= fun order ->
    Result.bind order start

let of_subject path subject =
  [ (("POST", path), Later (analyse subject)); (("GET", path), Look (Analyses.result subject));
    (("DELETE", path), Command (fun h _ -> Analyses.cancel subject h)) ]

let table =
  [ (("GET", "status"), Look (fun h -> json (Session.status h)));
    (("GET", "events"), Told (fun h role r -> Lwt.return (events h role r)));
    (("GET", "files"), Beside "files"); (("GET", "file"), Beside "file"); (("PUT", "file"), Save "save");
    (("GET", "layer"), Beside "layer"); (("GET", "tile"), Beside "tile");
    (("POST", "check"), Beside "check"); (("POST", "complete"), Beside "complete"); (("POST", "hover"), Beside "hover");
    (("POST", "signature"), Beside "signature"); (("POST", "definition"), Beside "definition");
    (("POST", "format"), Beside "format"); (("POST", "shapes"), Beside "shapes");
    (("PUT", "layer"), Save "import"); (("GET", "world"), Beside "world"); (("POST", "plans"), Told plans);
    (("POST", "run"), Later Run_commands.start); (("POST", "run/counterexample"), Command Run_commands.enact);
    (("POST", "run/stop"), Steer Run_commands.stop);
    (("POST", "run/answer"), Answer (fun h client found -> Lwt.return (Run_commands.answer h client found)));
    (("POST", "run/post"), Answer Run_commands.post);
    (("POST", "run/resume"), Later Run_commands.resume);
    (("POST", "run/differences"), Told differences); (("POST", "run/replace"), Later Run_commands.replace);
    (("GET", "runs"), Beside "runs"); (("GET", "replay"), Told replay); (("POST", "helm"), Steer helm);
    (("GET", "notes"), Beside "notes"); (("POST", "notes"), Told note);
    (("GET", "operators"), Told operators); (("POST", "operators"), Steer shut_out) ]
  @ of_subject "exploration" Exploration @ of_subject "timing" Timing @ of_subject "graph" Graph
  @ of_subject "replacement" Replacement

let routes = List.map (fun ((verb, path), _) -> (verb, "/api/" ^ path)) table

let answerer = refusal 403 "answers" "this link is for answers and inputs: it commands nothing else"

(* Commands are read in this process: they are short. *)
let longest_command = 64 * 1024

let command_body (r : Request.t) =
  if String.length r.body > longest_command then refuse 413 "too-large" "a command is shorter" else body r

(* The client, if it has the helm or gets it by this. *)
let helmsman h r =
  let* client = client h Steers r in
  Result.map (fun () -> client) (Result.map_error (refusal 409 "no-helm") (Session.command h client))

let command h r =
  let* found = command_body r in
  let* client = helmsman h r in
  Ok (client, found)

(* Without the helm, also a client that steers, if the question is for its operator. *)
let answering h role r =
  let* found = command_body r in
  Result.map (fun client -> (client, found)) (client h role r)

let perform h (role : Access.role) (r : Request.t) route =
  let refused r = Lwt.return (of_refusal r) in
  match route, role with
  | Look f, _ -> Lwt.return (f h)
  | Told f, _ -> f h role r >|= (function Ok response -> response | Error r -> of_refusal r)
  | Beside task, _ -> (
      match client h role r with Ok client -> beside h role ~client task r | Error r -> refused r)
  | Answer f, (Steers | Answers) -> (
      let without_helm = answering h role r in
      let is_free =
        role = Answers || Result.fold without_helm ~error:(fun _ -> false)
          ~ok:(fun (client, found) -> Run_commands.is_addressed h client found) in
      match if is_free then without_helm else command h r with
      | Error r -> refused r
      | Ok (client, found) -> f h client found >|= of_result)
  | (Save _ | Command _ | Later _ | Steer _ | Answer _), Watches -> refused watcher
  | (Save _ | Command _ | Later _ | Steer _), Answers -> refused answerer
  | Save task, Steers -> (
      match helmsman h r with Ok client -> beside h Steers ~client task r | Error r -> refused r)
  | Command f, Steers -> Lwt.return (of_result (Result.bind (command h r) (fun (_, found) -> f h found)))
  | Later f, Steers -> (
      match command h r with
      | Error r -> refused r
      | Ok (client, found) ->
        f h ~client r found >|= (function Ok found -> json found | Error response -> response))
  | Steer f, Steers ->
    let done_ =
      let* found = command_body r in
      let* client = client h Steers r in
      f h client found
    in
    Lwt.return (of_result done_)

let api h role (r : Request.t) path =
  let verb = if r.verb = "HEAD" then "GET" else r.verb in
  match List.assoc_opt (verb, path) table with
  | Some route -> perform h role r route
  | None when List.exists (fun ((_, known), _) -> known = path) table ->
    Lwt.return (of_refusal (refusal 405 "bad-method" (verb ^ " is nothing that can be done here")))
  | None -> Lwt.return (of_refusal (refusal 404 "not-found" "there is nothing of this name"))

let protected h (response : Response.t) =
  let is_new (name, _) = not (List.mem_assoc name response.headers) in
  { response with
    headers = response.headers @ List.filter is_new (Access.headers ~tiles:(Session.settings h).tiles) }

let page h (r : Request.t) =
  match Access.enter (Session.access h) r with
  | Some headers -> Response.text ~headers ~kind:"text/plain" 303 ""
  | None ->
    let none = of_refusal (refusal 404 "not-found" "there is nothing of this name") in
    Option.value (Page.find (Session.settings h).page r) ~default:none

let reply h (r : Request.t) =
  let answered =
    match Access.check (Session.access h) r, r.path, r.verb with
    | Error (status, why), _, _ -> Lwt.return (of_refusal (refusal status "refused" why))
    | Ok role, "api" :: path, _ -> api h role r (String.concat "/" path)
    | Ok _, _, ("GET" | "HEAD") -> Lwt.return (page h r)
    | Ok _, _, _ -> Lwt.return (of_refusal (refusal 405 "bad-method" "pages can be read, and no more"))
  in
  answered >|= protected h
