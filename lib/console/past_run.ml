open Dolphin_app
open Dolphin_trace

(* The program of a journal, as it was when it ran. *)
let program_of folder (header : Header.t) =
  match Folder.inside folder header.program.path with
  | None -> None
  | Some _ -> (
      match Program_file.load ~set:header.program.set header.program.path with
      | Ok program when (Program_file.header program).hash = header.program.hash -> Some program
      | Ok _ | Error _ -> None)

type teller = Unknown | Plain | Whole of Narrator.t * Replay.t

let plain feed entry = Feed.add feed ~event:"journal" (Entry.to_string entry)

let rec tell_entry folder feed teller (entry : Entry.t) =
  match teller, entry with
  | Unknown, Header header -> (
      match program_of folder header with
      | None -> tell_entry folder feed Plain entry
      | Some program ->
        let replay = Replay.start ~hash:header.program.hash program.program in
        tell_entry folder feed (Whole (Narrator.make program feed, replay)) entry)
  | Whole (narrator, replay), entry -> (
      match Replay.feed replay entry with
      | Ok replay -> Narrator.replayed narrator entry replay; Whole (narrator, replay)
      | Error mismatch ->
        Narrator.remark narrator ~time:(Entry.time entry)
          ("the program has no run with this line of the journal: " ^ mismatch.reason);
        plain feed entry;
        Plain)
  | (Unknown | Plain), entry -> plain feed entry; Plain

let tell folder ~id path =
  let feed = Feed.create ~run:id in
  let teller = ref Unknown in
  match Journal_file.iter (fun entry -> teller := tell_entry folder feed !teller entry) path with
  | Ok () -> Ok feed
  | Error e -> Feed.close feed; Error e
