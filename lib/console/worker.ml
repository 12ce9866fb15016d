open Dolphin_json
open Exchange
open Dolphin_processes
module Request = Dolphin_http.Request
module Response = Dolphin_http.Response

(* {1 Tasks} *)

type task = Whole of (Workspace.t -> Request.t -> (Response.t, refusal) result)
          | Pieces of (Workspace.t -> Request.t -> (string -> unit) -> unit)

let look f = Whole (fun w r -> Result.map (fun found -> json found) (f w r))
let compute f = look (fun w (r : Request.t) -> Result.bind (body r) (f w))

(* Vehicles of a network need no fleet. *)
let check_start w (r : Request.t) =
  let* found = body r in
  let* path = get Field.text "program" found in
  let* named = optional Field.text "fleet" found in
  let* set = set found in
  let checked =
    if Request.parameter r "network" <> None && named = None then
      Result.map ignore (Workspace.program w ~set path)
    else Result.map ignore (Workspace.program_in_fleet w ~set ~fleet:named path)
  in
  Result.map (fun () -> `Assoc []) checked

let tasks =
  [ ("files", look Files.list); ("file", look Files.read); ("save", compute Files.save);
    ("layer", Whole Layers.layer); ("tile", Whole Layers.tile);
    ("check", compute Texts.check); ("complete", compute (Texts.at_place Documents.complete));
    ("hover", compute (Texts.at_place Documents.hover)); ("signature", compute (Texts.at_place Documents.signature));
    ("definition", compute Texts.definition); ("format", compute Texts.format);
    ("shapes", compute Texts.shapes); ("import", compute Layers.import);
    ("world", look Worlds.get); ("plans", compute Plans.prepare);
    ("exploration", compute (Analysis_work.prepare Exploration)); ("timing", compute (Analysis_work.prepare Timing));
    ("graph", compute (Analysis_work.prepare Graph)); ("replacement", compute (Analysis_work.prepare Replacement));
    ("differences", compute Replacement_work.differences); ("replace", compute Replacement_work.check);
    ("conclude", look Analysis_work.conclude);
    ("outlook", compute Outlook_work.compute);
    ("start", look check_start); ("broken-off", compute Kept_runs.broken_off);
    ("runs", look Kept_runs.list); ("journal", look Kept_runs.check); ("replay", Pieces Kept_runs.replay);
    ("notes", look Notes.list); ("note", compute Notes.add) ]

(* {1 Messages} *)

let length_of frame =
  let bytes = Bytes.create 4 in
  Bytes.set_int32_be bytes 0 (Int32.of_int (String.length frame));
  Bytes.to_string bytes

let framed text = length_of text ^ text

type order = { task : string; workspace : Workspace.t; query : (string * string) list }

let path_member name path = (name, Field.of_option (fun path -> `String path) path)

let head { task; workspace = w; query } =
  let query = List.map (fun (name, value) -> `List [ `String name; `String value ]) query in
  Canonical.to_string
    (`Assoc
       [ ("task", `String task); ("folder", `String (Folder.root w.folder)); path_member "fleet" w.fleet;
         path_member "own" w.own; ("query", `List query) ])

let pair json =
  match json with `List [ `String name; `String value ] -> Ok (name, value) | _ -> Error "not a name and a value"

let order_of head =
  let open Field in
  let* found = Result.bind (Host_value.parse head) members in
  let* task = get Field.text "task" found in
  let* folder = Result.bind (get Field.text "folder" found) Folder.make in
  let* fleet = Field.get (nullable Field.text) "fleet" found in
  let* own = Field.get (nullable Field.text) "own" found in
  let* query = Field.get (list pair) "query" found in
  Ok { task; workspace = { folder; fleet; own }; query }

let status_line (r : Response.t) =
  let header (name, value) = `List [ `String name; `String value ] in
  Canonical.to_string (`Assoc [ ("status", `Int r.status); ("headers", `List (List.map header r.headers)) ])

let response_of head body =
  let open Field in
  let* found = Result.bind (Host_value.parse head) members in
  let* status = Field.get whole "status" found in
  let* headers = Field.get (list pair) "headers" found in
  Ok { Response.status; headers; body }

(* {1 The process} *)

let send text = output_string stdout (framed text)

let receive () =
  let length = Int32.to_int (String.get_int32_be (really_input_string stdin 4) 0) in
  really_input_string stdin length

let reply (r : Response.t) =
  send (status_line r);
  match r.body with
  | Text "" -> ()
  | Text text -> send text
  | Stream _ -> assert false  (* tasks stream by [Pieces] *)

let perform { task; workspace; query } body =
  let request = { Request.verb = ""; path = []; query; headers = []; body } in
  match List.assoc_opt task tasks with
  | None -> reply (of_refusal (refusal 404 "not-found" "there is no such task"))
  | Some (Whole f) -> reply (match f workspace request with Ok found -> found | Error r -> of_refusal r)
  | Some (Pieces f) ->
    send (status_line (Response.text ~kind:"text/event-stream" 200 ""));
    f workspace request (fun piece -> if piece <> "" then (send piece; flush stdout))

let trouble error =
  match error with
  | Out_of_memory -> refusal 503 "too-large" "this takes more memory than a request may have"
  | Stack_overflow -> refusal 503 "too-large" "this is nested too deeply"
  | error -> refusal 500 "trouble" ("this is trouble of the server, not of the request: " ^ Printexc.to_string error)

(* Above this size of the heap, in words, memory is given back after a task. *)
let most_words = 16 * 1024 * 1024

let rec serve () =
  match receive () with
  | exception End_of_file -> ()
  | head ->
    let body = receive () in
    (match
       match order_of head with
       | Ok order -> perform order body
       | Error why -> reply (of_refusal (refusal 500 "trouble" why))
     with
     | () -> ()
     | exception Sys_error _ -> exit 0  (* the console has gone *)
     | exception error -> reply (of_refusal (trouble error)));
    send "";
    flush stdout;
    if (Gc.quick_stat ()).heap_words > most_words then Gc.compact ();
    serve ()

let nice = 10

(* Where memory runs out, the system ends a worker rather than the console. *)
let first_to_die () =
  match open_out "/proc/self/oom_score_adj" with
  | channel -> ( try output_string channel "1000"; close_out channel with Sys_error _ -> close_out_noerr channel)
  | exception Sys_error _ -> ()

let main ~megabytes =
  List.iter (fun signal -> Sys.set_signal signal Sys.Signal_ignore) [ Sys.sigint; Sys.sighup; Sys.sigpipe ];
  Process_limits.end_with_parent ();
  Process_limits.memory megabytes;
  first_to_die ();
  ignore (Unix.nice nice : int);
  set_binary_mode_in stdin true;
  set_binary_mode_out stdout true;
  serve ()
