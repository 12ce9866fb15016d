open Dolphin_app
open Dolphin_json
open Field
open Lwt.Infix
open Exchange
module Request = Dolphin_http.Request
module Response = Dolphin_http.Response
module Scenario = Dolphin_scenario.Scenario
module Service = Dolphin_service.Service

(* {1 Files} *)

let hash text = Digest.to_hex (Digest.string text)

let files h _ =
  let of_kind kind =
    let wanted (k, path) = if k = kind then Some (`String path) else None in
    `List (List.filter_map wanted (Folder.list (folder h)))
  in
  Ok (`Assoc [ ("programs", of_kind Folder.Program); ("fleets", of_kind Fleet); ("journals", of_kind Journal);
               ("layers", of_kind Layer) ])

let read_file h r =
  let* path = parameter r "path" in
  let* full = file h path in
  let* text =
    match Folder.kind full with
    | Some Journal -> bad "journals are told by replay"
    | Some Layer -> bad "layers are told by layer"
    | Some (Program | Fleet) | None -> text full
  in
  Ok (`Assoc [ ("path", `String path); ("text", `String text); ("hash", `String (hash text)) ])

let longest_text = 256 * 1024

let short text =
  if String.length text <= longest_text then Ok text
  else refuse 413 "too-large" (Printf.sprintf "a text has at most %d bytes here" longest_text)

(* Whoever saves tells what was read: what others changed meanwhile is not lost. *)
let save h found =
  let* path = get Field.text "path" found in
  let* text = Result.bind (get Field.text "text" found) short in
  let* before = optional Field.text "hash" found in
  let* full = Result.map_error (refusal 404 "not-found") (Folder.place (folder h) path) in
  let* () =
    match Folder.kind full with
    | Some (Journal | Layer) -> bad "journals and layers are not edited"
    | Some (Program | Fleet) | None -> Ok ()
  in
  let there = if Sys.file_exists full then Result.to_option (Text_file.read full) else None in
  if Option.map hash there <> before then
    refuse 409 "changed" "the file has changed since it was read"
      ~more:[ ("hash", of_option (fun text -> `String (hash text)) there) ]
  else
    let written =
      if there = None then Text_file.write full (fun channel -> output_string channel text)
      else Source_file.replace full text
    in
    match written with
    | Ok () -> Ok (`Assoc [ ("hash", `String (hash text)) ])
    | Error e -> refuse 422 "not-saved" (String.concat "; " (Error.sentences e))

(* {1 Texts under way} *)

let document h found =
  let* path = get Field.text "path" found in
  let* full = Result.map_error (refusal 404 "not-found") (Folder.place (folder h) path) in
  let* given = optional Field.text "text" found in
  let* source = match given with Some text -> short text | None -> text full in
  let of_fleet path = Option.map (fun text -> { Service.path; text }) (Result.to_option (Text_file.read path)) in
  let fleet = Option.bind (Exchange.fleet_path h ~program:full None) of_fleet in
  Ok (Documents.service ~file:full ~fleet ~may_read:(Folder.may_read (folder h)) source)

let check h found =
  let* d = document h found in
  Ok (`Assoc [ ("diagnostics", Documents.diagnostics d) ])

let at_place f h found =
  let* d = document h found in
  let* at = get whole "at" found in
  Ok (f d at)

let definition h found =
  let path file = of_option (fun path -> `String path) (Folder.inside (folder h) file) in
  at_place (Documents.definition ~path) h found

let format h found =
  let* d = document h found in
  Result.map_error (refusal 422 "faults") (Documents.format d)

(* {1 What a program runs in} *)

let position (p : Dolphin_geo.Position.t) : members =
  [ ("latitude", Canonical.number p.latitude); ("longitude", Canonical.number p.longitude) ]

let vehicle (v : Scenario.vehicle) : json =
  `Assoc ([ ("vehicle", `String v.id); ("type", `String v.kind); ("payload", texts v.payload);
            ("battery", Canonical.number v.battery) ] @ position v.position)

let plan (p : Scenario.plan) : json =
  `Assoc (("plan", `String p.name) :: Option.fold p.place ~none:[] ~some:position)

let parameter_of (p : Dolphin_syntax.Parameters.t) : json =
  let why = Option.fold p.description ~none:[] ~some:(fun text -> [ ("description", `String text) ]) in
  `Assoc
    ([ ("name", `String p.name); ("as", `String (Format.asprintf "%a" Dolphin_syntax.Parameters.pp p)) ] @ why)

(* What the fleet says may be posted, each key with the values as people type them. *)
let suggested (s : Scenario.t) (program : Dolphin_semantics.Core.program) : json =
  let of_key key =
    let typed x =
      let text = Format.asprintf "%a" Dolphin_semantics.Value.pp x in
      match Typed_input.read (key ^ ": " ^ text) with
      | Ok [ (k, y) ] when k = key && Dolphin_semantics.Value.compare x y = 0 -> Some text
      | Ok _ | Error _ -> None
    in
    let values (i : Scenario.input) = if i.key = key then List.concat i.rounds else [] in
    match List.sort_uniq compare (List.filter_map typed (List.concat_map values s.inputs)) with
    | [] -> None
    | found -> Some (key, texts found)
  in
  `Assoc (List.filter_map of_key program.inputs)

let world h r =
  let* path = parameter r "program" in
  let* program = program h path in
  let* fleet = fleet h ~program:program.path (Request.parameter r "fleet") in
  let fleet_path = Option.bind fleet.path (Folder.inside (folder h)) in
  let fences = Dolphin_semantics.Fences.list program.program.fences @ fleet.scenario.fences in
  Ok
    (`Assoc
       [ ("inputs", texts program.program.inputs);
         ("suggested", suggested fleet.scenario program.program);
         ("parameters", `List (List.map parameter_of program.parameters));
         ("fleet", of_option (fun path -> `String path) fleet_path);
         ("vehicles", `List (List.map vehicle fleet.scenario.vehicles));
         ("fences", `List (List.map On_map.fence fences));
         ("plans", `List (List.map plan fleet.scenario.plans)) ])

(* {1 Runs} *)

let not_busy h =
  if Hall.busy h then refuse 409 "busy" "a run goes on: one at a time" else Ok ()

let unavailable e = refusal 503 "unavailable" (String.concat "; " (Error.sentences e))

let started run : json = `Assoc [ ("run", `String (Live_run.id run)) ]

let speed found =
  let* speed = optional number "speed" found in
  match speed with
  | Some x when not (x > 0. && x <= 100_000.) -> bad "the speed is a number above 0, or null: as fast as it goes"
  | speed -> Ok speed

let start h found =
  let* () = not_busy h in
  let* path = get Field.text "program" found in
  let* named = optional Field.text "fleet" found in
  let* speed = speed found in
  let* set = set found in
  let* seed = optional whole "seed" found in
  let* answers = optional (list Field.text) "answers" found in
  let* people = optional truth "people" found in
  let settings = (Hall.settings h).run in
  let simulated = Run.is_simulated settings in
  let* program = program h ~set path in
  let* fleet = if simulated || named <> None then fleet h ~program:program.path named else Ok Fleet_file.nobody in
  let* program = within fleet program in
  let* () =
    if (not simulated) && speed <> None then bad "vehicles of a network are not simulated: their run has no speed"
    else Ok ()
  in
  let* journal = Result.map_error unavailable (Run_folder.fresh ~program:program.path) in
  let answers = Option.value answers ~default:[] and people = people = Some true in
  let settings = { settings with speed; seed; answers; people; socket = true } in
  let order = { Live_run.program; fleet; settings } in
  Ok (started (Hall.begin_run h (fun ~id ~changed -> Live_run.start ~id ~changed ~journal order)))

let subject_of = function
  | "exploration" -> Ok Hall.Exploration
  | "timing" -> Ok Hall.Timing
  | _ -> bad "of is \"exploration\" or \"timing\""

(* What an analysis has found, carried out on the simulated fleet. *)
let enact h found =
  let* () = not_busy h in
  let* subject = Result.bind (get Field.text "of" found) subject_of in
  let* speed = speed found in
  match Option.bind (Hall.analysis h subject) Analysis.shown with
  | None -> refuse 409 "no-counterexample" "no run was found that could be carried out"
  | Some (program, fleet, witness) ->
    Ok (started (Hall.begin_run h (fun ~id ~changed -> Live_run.enact ~id ~changed ~speed program fleet witness)))

let going_on h =
  match Hall.run h with
  | Some run when Live_run.goes_on run -> Ok run
  | Some _ | None -> refuse 409 "no-run" "no run goes on"

(* Without [all], each Stop goes one step further: two people who press it at once would end what the first one has
   begun, the vehicles' way home perhaps. *)
let stop h client found =
  let* all = optional truth "all" found in
  let* run = going_on h in
  let stopping : Live_run.stopping = match all with None -> Next | Some false -> Program | Some true -> All in
  Live_run.stop run stopping;
  if Helm.holder (Hall.helm h) <> Some client then Live_run.remark run (client ^ " stops it, without the helm");
  Ok (`Assoc [])

let answer h found =
  let* run = going_on h in
  let* number = get whole "question" found in
  let* text = get Field.text "text" found in
  let* () = Result.map_error (refusal 409 "answered") (Live_run.answer run number text) in
  Ok (`Assoc [])

(* A pair, or pairs as people type them. *)
let pairs found =
  match List.assoc_opt "pairs" found with
  | Some (`String text) -> needed (Typed_input.read text)
  | Some _ -> bad "pairs is a text, as in \"target: [1, 2]\""
  | None ->
    let* key = get Field.text "key" found in
    let* value = get any "value" found in
    let* value = needed (Host_value.data_of_json value) in
    Ok [ (key, value) ]

let post h found =
  match Result.bind (going_on h) (fun run -> Result.map (fun pairs -> (run, pairs)) (pairs found)) with
  | Error r -> Lwt.return (Error r)
  | Ok (run, pairs) ->
    Live_run.post run pairs >|= function
    | Ok time -> Ok (`Assoc [ ("time", Canonical.number time) ])
    | Error why -> refuse 422 "not-posted" why

(* {1 Runs that were} *)

let own h = match Hall.run h with Some run when Live_run.goes_on run -> Live_run.journal run | _ -> None

let all_runs h =
  let listed = Result.map_error unavailable (Run_folder.list ?except:(own h) ()) in
  let here (run : Run_folder.run) =
    Option.map (fun path -> (path, run)) (Folder.inside (folder h) run.header.program.path) in
  Result.map (List.filter_map here) listed

let most_runs = 200

let runs h _ =
  let* all = all_runs h in
  let of_run (path, (run : Run_folder.run)) : json =
    let state =
      match run.state with
      | Ended ending -> ending.how
      | Going_on -> "going on"
      | Broken_off -> "broken off"
    in
    `Assoc
      [ ("run", `String run.name); ("program", `String path); ("started", `String run.header.started);
        ("time", Canonical.number run.time); ("platform", `String run.header.platform); ("state", `String state) ]
  in
  Ok (`Assoc [ ("runs", `List (List.map of_run (List.filteri (fun i _ -> i < most_runs) all))) ])

let kept h name =
  let* all = all_runs h in
  let is_it (_, (run : Run_folder.run)) = run.name = name in
  Option.to_result ~none:(refusal 404 "not-found" ("there is no such run: " ^ name)) (List.find_opt is_it all)

let resume h found =
  let* () = not_busy h in
  let* name = get Field.text "run" found in
  let* people = optional truth "people" found in
  let* path, run = kept h name in
  let* () = if run.state = Broken_off then Ok () else refuse 409 "not-broken-off" "this run has not broken off" in
  let* program = program h ~set:run.header.program.set path in
  let fleet = { Fleet_file.nobody with path = None } in
  let settings = { (Hall.settings h).run with speed = run.header.speed; seed = None; people = people = Some true;
                                              socket = true } in
  let order = { Live_run.program; fleet; settings } in
  Ok (started (Hall.begin_run h (fun ~id ~changed -> Live_run.resume ~id ~changed ~journal:run.path order)))

let longest_journal = 64 * 1024 * 1024

let journal_path h r =
  match Request.parameter r "run", Request.parameter r "path" with
  | Some name, _ -> Result.map (fun (_, (run : Run_folder.run)) -> run.path) (kept h name)
  | None, Some path ->
    let* full = file h path in
    if Folder.kind full = Some Journal then Ok full else bad "this is no journal"
  | None, None -> bad "the query lacks run, or path"

let replay h r =
  let* path = journal_path h r in
  let* () =
    if (Unix.stat path).st_size > longest_journal then refuse 413 "too-large" "this journal is too long" else Ok () in
  match Past_run.tell (folder h) ~id:"replay" path with
  | Error e -> refuse 422 "no-journal" (String.concat "; " (Error.sentences e))
  | Ok feed ->
    let rec copy write offset =
      match Feed.read feed offset with
      | "", _ -> write "event: end\ndata: {}\n\n"
      | text, offset -> write text >>= fun () -> copy write offset
    in
    let whole write = Lwt.finalize (fun () -> copy write 0) (fun () -> Feed.close feed; Lwt.return_unit) in
    Ok (Response.stream ~kind:"text/event-stream" whole)

(* {1 The helm} *)

let client h role (r : Request.t) =
  let key =
    match Request.header r "x-dolphin-client", Request.parameter r "client" with
    | Some key, _ | None, Some key -> key
    | None, None -> "api"
  in
  if Visitors.is_key key then Ok (Hall.name h role key)
  else bad "a client's key has 1 to 64 letters, digits, points, dashes and underscores"

let take h client by =
  if not (Hall.watches h client) then
    refuse 409 "not-watching" "a client that has the helm looks on: GET /api/events?client=KEY"
  else Ok (Hall.set_helm h (by (Hall.helm h) client))

(* All who look on see in the log that it was taken. *)
let force h client =
  let before = Helm.holder (Hall.helm h) in
  let* () = take h client Helm.force in
  match Hall.run h, before with
  | Some run, Some other when other <> client && Live_run.goes_on run ->
    Ok (Live_run.remark run (Printf.sprintf "%s takes the helm from %s" client other))
  | (Some _ | None), _ -> Ok ()

let steer h client found =
  let* what = get Field.text "want" found in
  match what with
  | "take" -> take h client Helm.ask
  | "force" -> force h client
  | "keep" -> Ok (Hall.keep_helm h client)
  | "give-up" -> Ok (Hall.set_helm h (Helm.give_up (Hall.helm h) client))
  | _ -> bad "want is \"take\", \"force\", \"keep\" or \"give-up\""

let helm h client found =
  let* () = steer h client found in
  let helm = Hall.helm h in
  Ok (`Assoc [ ("holder", of_option (fun c -> `String c) (Helm.holder helm)); ("asking", texts (Helm.asking helm)) ])

(* {1 Routes} *)

type route =
  | Look of (Hall.t -> Request.t -> (json, refusal) result)
  | Compute of (Hall.t -> members -> (json, refusal) result)  (* changes nothing *)
  | Compute_beside of (Hall.t -> members -> (json, refusal) result Lwt.t)  (* likewise, in another process *)
  | Command of (Hall.t -> members -> (json, refusal) result)  (* needs the helm *)
  | Later of (Hall.t -> members -> (json, refusal) result Lwt.t)  (* likewise *)
  | Steer of (Hall.t -> string -> members -> (json, refusal) result)  (* of whoever steers, with or without the helm *)
  | Told of (Hall.t -> Access.role -> Request.t -> (Response.t, refusal) result Lwt.t)

let most_watchers = 60
let most_steerers = 40

let role_event (role : Access.role) client =
  let name = match role with Steers -> "steers" | Watches -> "watches" in
  Printf.sprintf "event: role\ndata: {\"role\":\"%s\",\"client\":\"%s\"}\n\n" name client

let events h (role : Access.role) r =
  let* client = client h role r in
  let most = match role with Steers -> most_steerers | Watches -> most_watchers in
  if Hall.watchers h role >= most then refuse 503 "too-many" "too many look on"
  else
    let last = match Request.header r "last-event-id" with Some id -> Some id | None -> Request.parameter r "last" in
    let follow write = write (role_event role client) >>= fun () -> Hall.follow h role ~client ~last write in
    Ok (Response.stream ~kind:"text/event-stream" follow)

let table =
  [ (("GET", "status"), Look (fun h _ -> Ok (Hall.status h)));
    (("GET", "events"), Told (fun h role r -> Lwt.return (events h role r)));
    (("GET", "files"), Look files);
    (("GET", "file"), Look read_file);
    (("PUT", "file"), Command save);
    (("GET", "layer"), Told (fun h _ -> Layers.layer h));
    (("GET", "tile"), Told (fun h _ -> Layers.tile h));
    (("POST", "check"), Compute check);
    (("POST", "complete"), Compute (at_place Documents.complete));
    (("POST", "hover"), Compute (at_place Documents.hover));
    (("POST", "signature"), Compute (at_place Documents.signature));
    (("POST", "definition"), Compute definition);
    (("POST", "format"), Compute format);
    (("GET", "world"), Look world);
    (("POST", "plans"), Compute_beside Plans.list);
    (("POST", "exploration"), Command (Analyses.start Exploration));
    (("GET", "exploration"), Look (Analyses.result Exploration));
    (("DELETE", "exploration"), Command (Analyses.cancel Exploration));
    (("POST", "timing"), Command (Analyses.start Timing));
    (("GET", "timing"), Look (Analyses.result Timing));
    (("DELETE", "timing"), Command (Analyses.cancel Timing));
    (("POST", "graph"), Command (Analyses.start Graph));
    (("GET", "graph"), Look (Analyses.result Graph));
    (("DELETE", "graph"), Command (Analyses.cancel Graph));
    (("POST", "run"), Command start);
    (("POST", "run/counterexample"), Command enact);
    (("POST", "run/stop"), Steer stop);
    (("POST", "run/answer"), Command answer);
    (("POST", "run/post"), Later post);
    (("POST", "run/resume"), Command resume);
    (("GET", "runs"), Look runs);
    (("GET", "replay"), Told (fun h _ r -> Lwt.return (replay h r)));
    (("POST", "helm"), Steer helm) ]

let routes = List.map (fun ((verb, path), _) -> (verb, "/api/" ^ path)) table

(* A command of whoever has the helm, or gets it by this. *)
let with_helm h r f =
  let allowed =
    let* found = body r in
    let* client = client h Steers r in
    Result.map (fun () -> found) (Result.map_error (refusal 409 "no-helm") (Hall.command h client))
  in
  match allowed with
  | Error r -> Lwt.return (of_refusal r)
  | Ok found -> f found >|= of_result

let watcher = refusal 403 "watches" "this link is for watching: it commands nothing"

let perform h (role : Access.role) r route =
  match route, role with
  | Look f, _ -> Lwt.return (of_result (f h r))
  | Compute f, _ -> Lwt.return (of_result (Result.bind (body r) (f h)))
  | Compute_beside f, _ -> (
      match body r with Ok found -> f h found >|= of_result | Error refused -> Lwt.return (of_refusal refused))
  | (Command _ | Later _ | Steer _), Watches -> Lwt.return (of_refusal watcher)
  | Command f, Steers -> with_helm h r (fun found -> Lwt.return (f h found))
  | Later f, Steers -> with_helm h r (f h)
  | Steer f, Steers ->
    let done_ =
      let* found = body r in
      let* client = client h Steers r in
      f h client found
    in
    Lwt.return (of_result done_)
  | Told f, _ -> f h role r >|= (function Ok response -> response | Error r -> of_refusal r)

let api h role (r : Request.t) path =
  let verb = if r.verb = "HEAD" then "GET" else r.verb in
  match List.assoc_opt (verb, path) table with
  | Some route -> perform h role r route
  | None when List.exists (fun ((_, known), _) -> known = path) table ->
    Lwt.return (of_refusal (refusal 405 "bad-method" (verb ^ " is nothing that can be done here")))
  | None -> Lwt.return (of_refusal (refusal 404 "not-found" "there is nothing of this name"))

let protected h (response : Response.t) =
  { response with headers = response.headers @ Access.headers ~tiles:(Hall.settings h).tiles }

let page h (r : Request.t) =
  match Access.enter (Hall.access h) r with
  | Some headers -> Response.text ~headers ~kind:"text/plain" 303 ""
  | None ->
    let none = of_refusal (refusal 404 "not-found" "there is nothing of this name") in
    Option.value (Page.find (Hall.settings h).page r.path) ~default:none

let reply h (r : Request.t) =
  let answered =
    match Access.check (Hall.access h) r, r.path, r.verb with
    | Error (status, why), _, _ -> Lwt.return (of_refusal (refusal status "refused" why))
    | Ok role, "api" :: path, _ -> api h role r (String.concat "/" path)
    | Ok _, _, ("GET" | "HEAD") -> Lwt.return (page h r)
    | Ok _, _, _ -> Lwt.return (of_refusal (refusal 405 "bad-method" "pages can be read, and no more"))
  in
  answered >|= protected h
