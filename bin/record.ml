open Dolphin_trace

type settings = { journal : string option; drawing : Drawing_file.t option; header : Header.t }

exception Broken of string

let now () =
  let t = Unix.gmtime (Unix.time ()) in
  Printf.sprintf "%04d-%02d-%02dT%02d:%02d:%02dZ" (t.tm_year + 1900) (t.tm_mon + 1) t.tm_mday t.tm_hour t.tm_min
    t.tm_sec

let header (program : Program_file.t) (fleet : Fleet_file.t) ~seed ~speed : Header.t =
  { program = Header.source ~path:program.path program.source;
    fleet = Option.map (fun path -> Header.source ~path fleet.source) fleet.path;
    platform = "sim";
    seed;
    speed;
    started = now () }

let is_wanted s = s.journal <> None || s.drawing <> None

type t = {
  settings : settings;
  channel : out_channel option;
  teller : Story.teller;
  recorder : Recorder.t option;  (* if anything is to be kept *)
}

let trouble path why = Printf.sprintf "the journal cannot be written: %s: %s" path why

(* "x: No space left on device" for some failures, "No space left on device" for others. *)
let reason path why =
  let prefix = path ^ ": " in
  let n = String.length prefix in
  if String.length why > n && String.sub why 0 n = prefix then String.sub why n (String.length why - n) else why

let protected path f = try f () with Sys_error why -> raise (Broken (trouble path (reason path why)))

(* Each line is out before what it tells of happens. *)
let write_line path channel entry =
  protected path (fun () ->
      output_string channel (Entry.to_string entry);
      output_char channel '\n';
      flush channel)

(* A slip of the pen must not cost anybody a program. *)
let would_overwrite settings =
  let fleet = Option.map (fun (s : Header.source) -> s.path) settings.header.fleet in
  let sources = settings.header.program.path :: Option.to_list fleet in
  let outputs = Option.to_list settings.journal @ Option.to_list (Option.map Drawing_file.path settings.drawing) in
  let same a b =
    match Unix.stat a, Unix.stat b with
    | a, b -> a.st_dev = b.st_dev && a.st_ino = b.st_ino
    | exception Unix.Unix_error _ -> false
  in
  List.find_opt (fun output -> List.exists (same output) sources) outputs

let start settings program =
  let make () =
    let channel = Option.map (fun path -> protected path (fun () -> open_out_bin path)) settings.journal in
    let teller = Story.start () in
    let write entry =
      (match settings.journal, channel with
       | Some path, Some channel -> write_line path channel entry
       | _, _ -> ());
      if settings.drawing <> None then Story.tell teller entry
    in
    let recorder = if is_wanted settings then Some (Recorder.make program settings.header write) else None in
    { settings; channel; teller; recorder }
  in
  match would_overwrite settings with
  | Some path -> Error (path ^ ": the run was to be written over its own program or fleet")
  | None -> ( match make () with r -> Ok r | exception Broken why -> Error why)

let observer r : Dolphin_runtime.Observer.t =
  match r.recorder with
  | None -> Dolphin_runtime.Observer.nobody
  | Some recorder -> { transition = Recorder.transition recorder; news = Recorder.news recorder }

let finish r ~time ~stuck =
  let close () =
    Option.iter (fun recorder -> Recorder.finish recorder ~time ~stuck) r.recorder;
    match r.settings.journal, r.channel with
    | Some path, Some channel -> protected path (fun () -> close_out channel)
    | _, _ -> ()
  in
  match close () with
  | exception Broken why -> Error why
  | () -> (
      match r.settings.drawing with
      | None -> Ok ()
      | Some drawing -> Drawing_file.write drawing (Story.finish r.teller))
