open Dolphin_app
open Dolphin_json
open Lwt.Infix

type settings = {
  folder : Folder.t;
  run : Run.settings;
  fleet : string option;
  dolphin : string;
  page : Page.t;
  tiles : string option;
  listen : Unix.inet_addr option;
  certificate : Certificate.t option;
  operators : Operators.operator list;
  proxy_header : string option;
  version : string;
  workers : Worker_pool.limits;
}

(* Clients that steer wait neither for clients that watch nor for replays, whose readers may be slow. *)
type pools = {
  steerers : Worker_pool.t;
  watchers : Worker_pool.t;
  replays_of_steerers : Worker_pool.t;
  replays_of_watchers : Worker_pool.t;
  own : Worker_pool.t;  (* for tasks of the console itself *)
}

let pools { dolphin; workers = l; _ } =
  let pool = Worker_pool.make ~dolphin in
  { steerers = pool l; watchers = pool { l with workers = max 1 (l.workers - 1); each = 1 };
    replays_of_steerers = pool { l with waiting = 0 };
    replays_of_watchers = pool { l with workers = max 1 (l.workers - 1); each = 1; waiting = 0 };
    own = pool { l with workers = 1; each = 1 } }

(* A page that sees one analysis over, and then another, may have missed that the second one ran: it goes by number. *)
type numbered = { number : int; analysis : Analysis.t }

type t = {
  settings : settings;
  instance : string;  (* another one for each start of a server *)
  grown : unit Lwt_condition.t;
  mutable access : Access.t;
  mutable run : Live_run.t option;
  heard : Heard.t option;  (* [None]: vehicles are simulated *)
  mutable starting : int;  (* requests that are about to begin a run *)
  mutable outlook : Outlook.t option;  (* of the run *)
  mutable run_file : string;  (* of its program *)
  mutable run_path : string option;  (* the same, in the folder *)
  pools : pools;
  mutable runs : int;
  mutable analyses : (Analysis.subject * numbered) list;  (* one of each at most *)
  mutable begun : int;  (* analyses *)
  visitors : Visitors.t;
  mutable helm : Helm.t;
  mutable alive : (string * float) list;  (* the time of the latest [keep] of each client *)
  mutable watching : (string * Access.role) list;  (* a client as often as it looks on *)
}

let make settings =
  let instance =
    Digest.to_hex (Digest.string (Printf.sprintf "%d %f" (Unix.getpid ()) (Unix.gettimeofday ()))) in
  let operators = if settings.listen = None && settings.proxy_header = None then [] else settings.operators in
  let grown = Lwt_condition.create () in
  let changed () = Lwt_condition.broadcast grown () in
  let heard =
    if Run.is_simulated settings.run then None else Some (Heard.make (Run.choice settings.run) ~changed) in
  { settings; instance = String.sub instance 0 8; grown; heard; starting = 0;
    access = { port = 0; tls = settings.certificate <> None; operators; proxy_header = settings.proxy_header };
    run = None;
    outlook = None; run_file = ""; run_path = None; pools = pools settings; runs = 0;
    analyses = []; begun = 0; visitors = Visitors.make (); helm = Helm.free; alive = []; watching = [] }

let settings h = h.settings
let access h = h.access
let served_at h port = h.access <- { h.access with port }
let changed h = Lwt_condition.broadcast h.grown ()
let run h = h.run
let busy h = Option.fold h.run ~none:false ~some:Live_run.goes_on

let analysis h subject = Option.map (fun a -> a.analysis) (List.assoc_opt subject h.analyses)
let analyses h = List.map (fun (_, a) -> a.analysis) h.analyses
let helm h = h.helm
let name h = Visitors.name h.visitors

let record_of h client =
  let owner = Visitors.owner client in
  List.find_opt (fun (o : Operators.operator) -> o.name = Some owner) h.access.operators

let operator h client : Live_run.operator option =
  let named (o : Operators.operator) : Live_run.operator =
    { name = Visitors.owner client; role = Operators.role_word o } in
  Option.map named (record_of h client)

let has_names h = List.exists (fun (o : Operators.operator) -> o.name <> None) h.access.operators

(* One who was shut out has no record any more. *)
let is_known h client = (not (has_names h)) || record_of h client <> None
let addressee h prompt = Operators.addressee h.access.operators prompt

let may_answer h client prompt =
  match record_of h client with
  | Some o -> Operators.may_answer h.access.operators o prompt
  | None -> addressee h prompt = None

let streams_of h client = List.length (List.filter (fun (other, _) -> other = client) h.watching)
let watchers h role = List.length (List.filter (fun (_, of_client) -> of_client = role) h.watching)

(* {1 Vehicles that are heard} *)

(* Ports and adapters are those of the run while one goes on. *)
let listen_if_idle h =
  if h.starting = 0 && not (busy h) then Option.iter Heard.listen h.heard

let listening_left h begin_ =
  let leave heard =
    h.starting <- h.starting + 1;
    Heard.leave heard
  in
  let ended () =
    if h.heard <> None then h.starting <- h.starting - 1;
    (match h.run with
     | Some run when Live_run.goes_on run ->
       Lwt.async (fun () -> Live_run.finished run >|= fun () -> listen_if_idle h)
     | Some _ | None -> listen_if_idle h);
    Lwt.return_unit
  in
  Lwt.finalize (fun () -> Option.fold h.heard ~none:Lwt.return_unit ~some:leave >|= begin_) ended

let close h =
  let { steerers; watchers; replays_of_steerers; replays_of_watchers; own } = h.pools in
  List.iter Worker_pool.close [ steerers; watchers; replays_of_steerers; replays_of_watchers; own ];
  Option.iter Outlook.close h.outlook;
  h.starting <- h.starting + 1;
  Option.fold h.heard ~none:Lwt.return_unit ~some:Heard.leave

let worker_pids h =
  let { steerers; watchers; replays_of_steerers; replays_of_watchers; own } = h.pools in
  List.concat_map Worker_pool.pids [ steerers; watchers; replays_of_steerers; replays_of_watchers; own ]
  @ Option.fold h.outlook ~none:[] ~some:Outlook.pids

let workers h (role : Access.role) =
  match role with Steers | Answers -> h.pools.steerers | Watches -> h.pools.watchers

let replays h (role : Access.role) =
  match role with Steers | Answers -> h.pools.replays_of_steerers | Watches -> h.pools.replays_of_watchers

let own_workers h = h.pools.own

let workspace h : Workspace.t =
  let own = match h.run with Some run when Live_run.goes_on run -> Live_run.journal run | Some _ | None -> None in
  { folder = h.settings.folder; fleet = h.settings.fleet; own }

(* Another program may have come in its place. *)
let note_program h run =
  let { Program_file.path; _ } = Live_run.program run in
  if path <> h.run_file then begin
    h.run_file <- path;
    h.run_path <- Folder.inside h.settings.folder path
  end

let begin_run h start =
  let before = h.run in
  h.runs <- h.runs + 1;
  let changed_run () = Option.iter (note_program h) h.run; changed h in
  let run = start ~id:(Printf.sprintf "%s-%d" h.instance h.runs) ~changed:changed_run in
  h.run <- Some run;
  Option.iter Outlook.close h.outlook;
  let workspace () = workspace h in
  let follow = Outlook.follow ~dolphin:h.settings.dolphin ~changed:(fun () -> changed h) ~workspace in
  h.outlook <- Some (follow run);
  note_program h run;
  Option.iter (fun run -> Feed.close (Live_run.feed run)) before;
  changed h;
  run

let set_analysis h subject started =
  Option.iter Analysis.cancel (analysis h subject);
  h.begun <- h.begun + 1;
  h.analyses <- (subject, { number = h.begun; analysis = started }) :: List.remove_assoc subject h.analyses;
  changed h

(* The journal of a run has each change of the helm. *)
let keep_change h ~before ~now =
  let keep run deed client = Live_run.acted run (operator h client) deed in
  let name client = Option.map (fun (o : Live_run.operator) -> o.name) (operator h client) in
  match h.run, before, now with
  | Some run, Some client, None -> keep run Leave_helm client
  | Some run, before, Some client when before <> Some client ->
    keep run (Take_helm (Option.bind before name)) client
  | (Some _ | None), _, _ -> ()

let set_helm h helm =
  if not (Helm.equal helm h.helm) then begin
    let before = Helm.holder h.helm in
    h.helm <- helm;
    keep_change h ~before ~now:(Helm.holder helm);
    changed h
  end

let watches h client = List.mem_assoc client h.watching

let most_silent = 8.

let keep_helm h client =
  let now = Unix.gettimeofday () in
  h.alive <- (client, now) :: List.remove_assoc client h.alive;
  let check () =
    if List.assoc_opt client h.alive = Some now then begin
      h.alive <- List.remove_assoc client h.alive;
      set_helm h (Helm.give_up h.helm client)
    end
  in
  Lwt.async (fun () -> Lwt_unix.sleep most_silent >|= check)

let command h client =
  let had helm = if watches h client then set_helm h helm in
  Result.map had (Helm.command h.helm client)

(* {1 The status} *)

let of_run h run : Yojson.Safe.t =
  match Live_run.to_json ~addressee:(addressee h) run with
  | `Assoc members ->
    `Assoc
      (members
       @ [ ("outlook", Option.fold h.outlook ~none:`Null ~some:Outlook.to_json);
           ("program", Field.of_option (fun path -> `String path) h.run_path);
           ("journal", Field.of_option (fun path -> `String (Filename.remove_extension (Filename.basename path)))
              (Live_run.journal run)) ])
  | json -> json

(* Of an analysis only how it goes: its result may be long. *)
let of_analysis a : Yojson.Safe.t = `Assoc (("number", `Int a.number) :: Analysis.progress a.analysis)

let status h : Yojson.Safe.t =
  `Assoc
    [ ("server", `String "dolphin-console"); ("protocol", `Int 1); ("version", `String h.settings.version);
      ("instance", `String h.instance); ("folder", `String (Folder.root h.settings.folder));
      ("tiles", Field.of_option (fun url -> `String url) h.settings.tiles);
      ("simulated", `Bool (Run.is_simulated h.settings.run));
      ("run", Field.of_option (of_run h) h.run);
      ("exploration", Field.of_option of_analysis (List.assoc_opt Analysis.Exploration h.analyses));
      ("timing", Field.of_option of_analysis (List.assoc_opt Analysis.Timing h.analyses));
      ("graph", Field.of_option of_analysis (List.assoc_opt Analysis.Graph h.analyses));
      ("replacement", Field.of_option of_analysis (List.assoc_opt Analysis.Replacement h.analyses));
      ("helm",
       `Assoc
         [ ("holder", Field.of_option (fun client -> `String client) (Helm.holder h.helm));
           ("asking", Field.texts (Helm.asking h.helm));
           ("taken_from", Field.of_option (fun client -> `String client) (Helm.taken_from h.helm)) ]);
      ("watching", `Int (List.length h.watching)) ]

(* {1 Operators} *)

let operators h : Yojson.Safe.t =
  let one (o : Operators.operator) : Yojson.Safe.t option =
    let json name : Yojson.Safe.t =
      let pages = List.filter (fun (client, _) -> Visitors.owner client = name) h.watching in
      `Assoc [ ("name", `String name); ("role", `String (Operators.role_word o)); ("duties", Field.texts o.duties);
               ("pages", `Int (List.length pages)) ]
    in
    Option.map json o.name
  in
  `Assoc [ ("operators", `List (List.filter_map one h.access.operators)) ]

let is_admin h client = Option.fold (record_of h client) ~none:false ~some:(fun (o : Operators.operator) -> o.admin)

(* At least the admin stays: a console without operators would trust every client. *)
let shut_out h client name =
  let is_other (o : Operators.operator) = o.name = Some name && Visitors.owner client <> name in
  if not (List.exists is_other h.access.operators) then Error "there is no other operator of this name"
  else begin
    Option.iter (fun run -> Live_run.acted run (operator h client) (Shut_out name)) h.run;
    let holder = Helm.holder h.helm in
    let pages = List.filter (fun (other, _) -> Visitors.owner other = name) h.watching in
    List.iter (fun (other, _) -> set_helm h (Helm.give_up h.helm other)) pages;
    Option.iter (fun other -> if Visitors.owner other = name then set_helm h (Helm.give_up h.helm other)) holder;
    h.access <- Access.without h.access name;
    changed h;
    Ok ()
  end

(* {1 Events} *)

let event name json = Printf.sprintf "event: %s\ndata: %s\n\n" name (Canonical.to_string json)

(* The status without the time: the event [clock] has it. *)
let without_time : Yojson.Safe.t -> Yojson.Safe.t =
  let without members = `Assoc (List.filter (fun (name, _) -> name <> "time") members) in
  function
  | `Assoc members ->
    `Assoc
      (List.map (fun (name, json) ->
           match name, (json : Yojson.Safe.t) with
           | "run", `Assoc run -> (name, without run)
           | _, _ -> (name, json))
          members)
  | json -> json

type reader = {
  mutable told : string;
  mutable heard_told : Yojson.Safe.t;
  mutable run_id : string;
  mutable offset : int;
  mutable spoken : float;
}

let clock h =
  match h.run with
  | Some run when Live_run.goes_on run -> event "clock" (`Assoc [ ("time", Canonical.number (Live_run.now run)) ])
  | Some _ | None -> "event: beat\ndata: {}\n\n"

let next_of_run h reader =
  match h.run with
  | None -> None
  | Some run when Live_run.id run <> reader.run_id ->
    reader.run_id <- Live_run.id run;
    reader.offset <- 0;
    Some (event "run" (`Assoc [ ("id", `String reader.run_id) ]))
  | Some run -> (
      match Feed.read (Live_run.feed run) reader.offset with
      | "", _ -> None
      | text, offset -> reader.offset <- offset; Some text)

let next_status h reader =
  let status = event "status" (without_time (status h)) in
  if status = reader.told then None
  else begin
    reader.told <- status;
    Some status
  end

let next_heard h reader =
  match h.heard with
  | Some heard when (not (busy h)) && Heard.to_json heard != reader.heard_told ->
    reader.heard_told <- Heard.to_json heard;
    Some (event "heard" reader.heard_told)
  | Some _ | None -> None

(* The next message, if there is one. All messages of a run precede the status in which it is over. *)
let next h reader =
  let rec first = function
    | [] -> None
    | one :: others -> ( match one h reader with Some text -> Some text | None -> first others)
  in
  if reader.told = "" then next_status h reader else first [ next_of_run; next_status; next_heard ]

(* Changes within this time, in seconds, are sent together. *)
let collected = 0.01

(* A page that hears nothing for longer shows that its server is gone. *)
let beat = 1.

let wait h reader =
  let news = Lwt_condition.wait h.grown >>= fun () -> Lwt_unix.sleep collected in
  let silence = reader.spoken +. beat -. Unix.gettimeofday () in
  Lwt.pick [ news; Lwt_unix.sleep (Float.max 0. (Float.min beat silence)) ]

let rec tell h ~client reader write =
  let now = Unix.gettimeofday () in
  let text =
    match next h reader with
    | Some text -> Some text
    | None -> if now >= reader.spoken +. beat then Some (clock h) else None
  in
  match text with
  | _ when not (is_known h client) -> Lwt.return_unit
  | Some text ->
    reader.spoken <- now;
    write text >>= fun () -> tell h ~client reader write
  | None -> wait h reader >>= fun () -> tell h ~client reader write

(* {1 Clients that follow events} *)

let rec without_one client = function
  | [] -> []
  | (other, _) :: rest when other = client -> rest
  | other :: rest -> other :: without_one client rest

(* A page that is loaded again comes back at once. *)
let grace = 5.

let leave h client =
  h.watching <- without_one client h.watching;
  changed h;
  let give_up () = if not (watches h client) then set_helm h (Helm.give_up h.helm client) in
  Lwt.async (fun () -> Lwt_unix.sleep grace >|= give_up)

let follow h role ~client ~last write =
  let run_id, offset =
    match h.run, last with
    | Some run, Some last when Feed.resumed (Live_run.feed run) last > 0 ->
      (Live_run.id run, Feed.resumed (Live_run.feed run) last)
    | (Some _ | None), _ -> ("", 0)
  in
  let reader = { told = ""; heard_told = `Null; run_id; offset; spoken = 0. } in
  h.watching <- (client, role) :: h.watching;
  changed h;
  Lwt.finalize (fun () -> write "retry: 1000\n\n" >>= fun () -> tell h ~client reader write)
    (fun () -> leave h client; Lwt.return_unit)
