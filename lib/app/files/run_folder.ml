open Dolphin_trace

type state = Ended of Request.ending | Going_on | Broken_off
type run = { name : string; path : string; header : Header.t; time : float; state : state }

let ( let* ) = Result.bind

(* {1 The folder} *)

let variable name = match Sys.getenv_opt name with Some "" | None -> None | Some value -> Some value

let folder () =
  let runs state = Filename.concat (Filename.concat state "dolphin") "runs" in
  match variable "XDG_STATE_HOME", variable "HOME" with
  | Some state, _ when not (Filename.is_relative state) -> Ok (runs state)
  | _, Some home -> Ok (runs (Filename.concat (Filename.concat home ".local") "state"))
  | _, None ->
    let why = "runs have no folder: the environment has neither HOME nor XDG_STATE_HOME, an absolute path" in
    Error (Error.Unavailable why)

let rec make path =
  if not (Sys.file_exists path) then begin
    make (Filename.dirname path);
    try Unix.mkdir path 0o700 with Unix.Unix_error (EEXIST, _, _) -> ()
  end

let beside name =
  let* runs = folder () in
  let path = Filename.concat (Filename.dirname runs) name in
  match make path with
  | () -> Ok path
  | exception Unix.Unix_error (error, _, _) ->
    Error (Error.Unavailable (Printf.sprintf "%s: %s" path (Unix.error_message error)))

let ending = ".run"

let rec unused folder base n =
  let name = if n = 1 then base else Printf.sprintf "%s-%d" base n in
  let path = Filename.concat folder (name ^ ending) in
  match Unix.openfile path [ O_WRONLY; O_CREAT; O_EXCL; O_CLOEXEC ] 0o666 with
  | fd -> Unix.close fd; path
  | exception Unix.Unix_error (EEXIST, _, _) -> unused folder base (n + 1)

(* A run that did not begin leaves nothing behind. *)
let forget_if_empty path =
  match Unix.stat path with
  | { st_size = 0; _ } -> ( try Sys.remove path with Sys_error _ -> ())
  | _ | (exception Unix.Unix_error _) -> ()

let fresh ~program =
  let* folder = folder () in
  let t = Unix.gmtime (Unix.time ()) in
  let base =
    Printf.sprintf "%04d-%02d-%02dT%02d%02d%02dZ-%s" (t.tm_year + 1900) (t.tm_mon + 1) t.tm_mday t.tm_hour t.tm_min
      t.tm_sec
      (Filename.remove_extension (Filename.basename program))
  in
  match make folder; unused folder base 1 with
  | path -> at_exit (fun () -> forget_if_empty path); Ok path
  | exception Unix.Unix_error (error, _, _) ->
    Error (Error.Unavailable (Printf.sprintf "%s: %s" folder (Unix.error_message error)))

let rec nearest path = if Sys.file_exists path then path else nearest (Filename.dirname path)

let writable () =
  let* folder = folder () in
  match Unix.access (nearest folder) [ W_OK; X_OK ] with
  | () -> Ok folder
  | exception Unix.Unix_error (error, _, _) ->
    Error (Error.Unavailable (Printf.sprintf "%s: %s" folder (Unix.error_message error)))

(* {1 Its runs} *)

(* Enough for the last line of any run but those that end with a very long message. *)
let tail = 65536

let last_entry channel =
  let length = in_channel_length channel in
  let size = min length tail in
  seek_in channel (length - size);
  let lines = String.split_on_char '\n' (really_input_string channel size) in
  List.find_map (fun line -> Result.to_option (Entry.of_string line)) (List.rev lines)

(* Consoles lock the journals that they write. *)
let is_written channel =
  match Unix.lockf (Unix.descr_of_in_channel channel) F_TEST 0 with
  | () -> false
  | exception Unix.Unix_error ((EACCES | EAGAIN), _, _) -> true
  | exception Unix.Unix_error _ -> false

let read path channel =
  match Journal.next (Journal.of_channel channel) with
  | Line { entry = Header header; _ } ->
    let time, state =
      match last_entry channel with
      | Some (End { time; ending; _ }) -> (time, Ended ending)
      | last -> (Option.fold ~none:0. ~some:Entry.time last, if is_written channel then Going_on else Broken_off)
    in
    Ok { name = Filename.remove_extension (Filename.basename path); path; header; time; state }
  | Line _ | Torn _ | End_of_file | Wrong _ -> Error (Error.Bad_input (path ^ ": this is not a journal"))

let files folder =
  if not (Sys.file_exists folder) then Ok []
  else
    match Sys.readdir folder with
    | files -> Ok (Array.to_list files)
    | exception Sys_error why -> Error (Error.Unavailable why)

let list ?except () =
  let* folder = folder () in
  let* files = files folder in
  let journals = List.filter (fun file -> Filename.check_suffix file ending) files in
  let run file =
    let path = Filename.concat folder file in
    if except = Some path then None else Result.to_option (Text_file.with_channel path (read path))
  in
  Ok (List.filter_map run (List.sort (fun a b -> compare b a) journals))

let find name =
  let* runs = list () in
  let begins (run : run) =
    String.length run.name >= String.length name && String.sub run.name 0 (String.length name) = name in
  match runs, List.find_opt (fun run -> run.name = name) runs, List.filter begins runs with
  | latest :: _, _, _ when name = "latest" -> Ok latest.path
  | _, Some run, _ | _, None, [ run ] -> Ok run.path
  | _, None, [] -> Error (Error.Bad_input (Printf.sprintf "no run '%s': dolphin runs lists them" name))
  | _, None, _ :: _ :: _ -> Error (Error.Bad_input (Printf.sprintf "several runs begin with '%s'" name))

let journal name = if Filename.basename name <> name || Sys.file_exists name then Ok name else find name
