open Dolphin_app
open Dolphin_json
open Exchange
module Request = Dolphin_http.Request

let unavailable e = refusal 503 "unavailable" (String.concat "; " (Error.sentences e))

let all (w : Workspace.t) =
  let listed = Result.map_error unavailable (Run_folder.list ?except:w.own ()) in
  let here (run : Run_folder.run) =
    Option.map (fun path -> (path, run)) (Folder.inside w.folder run.header.program.path) in
  Result.map (List.filter_map here) listed

let most = 200

let list w _ =
  let* all = all w in
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
  Ok (`Assoc [ ("runs", `List (List.map of_run (List.filteri (fun i _ -> i < most) all))) ])

let find w name =
  let* all = all w in
  let is_it (_, (run : Run_folder.run)) = run.name = name in
  Option.to_result ~none:(refusal 404 "not-found" ("there is no such run: " ^ name)) (List.find_opt is_it all)

(* {1 To resume one} *)

type broken_off = { path : string; journal : string; set : (string * string) list; speed : float option }

let broken_off w found =
  let* name = get Field.text "run" found in
  let* path, run = find w name in
  let* () = if run.state = Broken_off then Ok () else refuse 409 "not-broken-off" "this run has not broken off" in
  (* Another one may have come in the place of the first. *)
  let source = Option.value (Journal_file.program run.path) ~default:run.header.program in
  let path = Option.value (Folder.inside w.folder source.path) ~default:path in
  let set = List.map (fun (name, text) -> (name, `String text)) source.set in
  Ok
    (`Assoc
       [ ("path", `String path); ("journal", `String run.path); ("set", `Assoc set);
         ("speed", Field.of_option Canonical.number run.header.speed) ])

let of_json found =
  let* path = get Field.text "path" found in
  let* journal = get Field.text "journal" found in
  let* set = set found in
  let* speed = optional Field.number "speed" found in
  Ok { path; journal; set; speed }

(* {1 To replay one} *)

let journal w ~run ~path =
  match run, path with
  | Some name, _ -> Result.map (fun (_, (run : Run_folder.run)) -> run.path) (find w name)
  | None, Some path ->
    let* full = Workspace.file w path in
    if Folder.kind full = Some Journal then Ok full else bad "this is not a journal"
  | None, None -> bad "the request lacks run, or path"

let no_journal e = refusal 422 "no-journal" (String.concat "; " (Error.sentences e))

(* The first line alone: the others are read as they are sent. *)
let check w r =
  let* path = journal w ~run:(Request.parameter r "run") ~path:(Request.parameter r "path") in
  let first reader =
    match Dolphin_trace.Journal.peek reader with
    | Line _ | Torn _ | End_of_file -> Ok (`Assoc [ ("journal", `String path) ])
    | Wrong { number; why } -> Error (Journal_file.wrong path ~number why)
  in
  Result.map_error no_journal (Journal_file.with_reader path first)

(* Bytes of a piece. *)
let piece = 65_536

let replay (w : Workspace.t) r write =
  match parameter r "journal" with
  | Error _ -> ()
  | Ok path ->
    let buffer = Buffer.create (2 * piece) in
    let send () =
      write (Buffer.contents buffer);
      Buffer.clear buffer
    in
    let tell ~event data =
      Buffer.add_string buffer (Printf.sprintf "event: %s\ndata: %s\n\n" event data);
      if Buffer.length buffer >= piece then send ()
    in
    (match Past_run.tell w.folder path tell with
     | Ok () -> tell ~event:"end" "{}"
     | Error e ->
       let message = String.concat "; " (Error.sentences e) in
       tell ~event:"failed" (Canonical.to_string (`Assoc [ ("message", `String message) ])));
    if Buffer.length buffer > 0 then send ()
