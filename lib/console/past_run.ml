open Dolphin_app
open Dolphin_trace

(* Where the program of a journal may be: where it was, seen from here or from the folder; or beside the journal, which
   has come from another machine with it. *)
let places folder ~journal path =
  let root = Folder.root folder and name = Filename.basename path in
  let relative = if Filename.is_relative path then [ Filename.concat root path ] else [] in
  (path :: relative) @ [ Filename.concat (Filename.dirname journal) name; Filename.concat root name ]

(* The program of a journal, as it was when it ran. *)
let program_of folder ~journal { Header.path; hash; set } =
  let unchanged path =
    match Program_file.load ~set ~may_read:(Folder.may_read folder) path with
    | Ok program when (Program_file.header program).hash = hash -> Some program
    | Ok _ | Error _ -> None
  in
  let here path = Option.bind (Folder.inside folder path) (fun _ -> unchanged path) in
  List.find_map here (places folder ~journal path)

type teller = Unknown | Plain | Whole of Narrator.t * Replay.t

let plain (tell : Narrator.tell) entry = tell ~event:"journal" (Entry.to_string entry)

(* The program in the folder that the places are in. *)
let tell_program folder (tell : Narrator.tell) program =
  let path = Option.bind program (fun (p : Program_file.t) -> Folder.inside folder p.path) in
  let json = `Assoc [ ("program", Dolphin_json.Field.of_option (fun path -> `String path) path) ] in
  tell ~event:"program" (Dolphin_json.Canonical.to_string json)

(* The reason why the log is missing. *)
let lacks_program tell ({ path; _ } : Header.source) =
  let what = Printf.sprintf "%s is not in this folder, or has changed: no log" path in
  Narrator.remark_on tell ~time:0. what

let rec tell_entry folder tell ~journal teller (entry : Entry.t) =
  match teller, entry with
  | Unknown, Header header -> (
      (* The whole journal is one of a run of this program. *)
      let source = Option.value (Journal_file.program journal) ~default:header.program in
      let program = program_of folder ~journal source in
      tell_program folder tell program;
      match program with
      | None -> plain tell entry; lacks_program tell source; Plain
      | Some program ->
        let replay = Replay.start ~hash:source.hash program.program in
        tell_entry folder tell ~journal (Whole (Narrator.make program tell, replay)) entry)
  | Whole (narrator, replay), entry -> (
      match Replay.feed replay entry with
      | Ok replay -> Narrator.replayed narrator entry replay; Whole (narrator, replay)
      | Error mismatch ->
        Narrator.remark narrator ~time:(Entry.time entry)
          ("the program has no run with this line of the journal: " ^ mismatch.reason);
        plain tell entry;
        Plain)
  | (Unknown | Plain), entry -> plain tell entry; Plain

let tell folder path tell =
  let teller = ref Unknown in
  Journal_file.iter (fun entry -> teller := tell_entry folder tell ~journal:path !teller entry) path
