module Search = Dolphin_explore.Search

type t = { directory : string; inputs : string }

(* The specification of XDG has it that a relative path is ignored. *)
let directory () =
  let is_absolute path = not (Filename.is_relative path) in
  let absolute name = Option.bind (Sys.getenv_opt name) (fun path -> if is_absolute path then Some path else None) in
  let cache =
    match absolute "XDG_CACHE_HOME", absolute "HOME" with
    | Some path, _ -> Some path
    | None, Some home -> Some (Filename.concat home ".cache")
    | None, None -> None
  in
  Option.map (fun cache -> List.fold_left Filename.concat cache [ "dolphin"; "explore" ]) cache

(* On systems with this link, it leads to the file that runs, although there may be another one now at its path. *)
let running = "/proc/self/exe"

let executable () =
  let path = if Sys.file_exists running then running else Sys.executable_name in
  match Digest.file path with digest -> Some digest | exception Sys_error _ -> None

let make (settings : Exploration.settings) (program : Program_file.t) (fleet : Fleet_file.t) =
  match directory (), executable () with
  | None, _ | _, None -> None
  | Some directory, Some executable ->
    (* However many processes search, they find the same. *)
    let settings = { settings with workers = 1 } in
    let inputs = (executable, settings, program.path, program.source, program.set, fleet.path, fleet.source) in
    Some { directory; inputs = Marshal.to_string inputs [ No_sharing ] }

let path t = Filename.concat t.directory (Digest.to_hex (Digest.string t.inputs))

(* {1 Files}

   The digest of the rest: the inputs, and the result. *)

let read path =
  match open_in_bin path with
  | exception Sys_error _ -> None
  | channel ->
    let contents () = really_input_string channel (in_channel_length channel) in
    Fun.protect
      ~finally:(fun () -> close_in_noerr channel)
      (fun () -> try Some (contents ()) with Sys_error _ | End_of_file -> None)

let find t =
  let digest_length = String.length (Digest.string "") in
  match read (path t) with
  | Some contents when String.length contents > digest_length ->
    let rest = String.sub contents digest_length (String.length contents - digest_length) in
    if Digest.string rest <> String.sub contents 0 digest_length then None
    else
      let inputs, (found : Search.outcome) = Marshal.from_string rest 0 in
      if String.equal inputs t.inputs then Some found else None
  | Some _ | None -> None

let rec make_directory path =
  if not (Sys.file_exists path) then begin
    make_directory (Filename.dirname path);
    try Sys.mkdir path 0o700 with Sys_error _ when Sys.file_exists path -> ()
  end

let is_conclusive (o : Search.outcome) =
  let is_open = function
    | _, Search.Inconclusive _ -> true
    | _, (Holds | Holds_if _ | Violated _ | By_design _ | Unreached _) -> false
  in
  o.stopped = None && not (List.exists is_open o.verdicts)

(* Another process never sees a part of it. *)
let keep t o =
  if not (is_conclusive o) then Ok ()
  else
    match make_directory t.directory with
    | () ->
      let contents = Marshal.to_string (t.inputs, o) [] in
      Text_file.write (path t) (fun channel -> output_string channel (Digest.string contents ^ contents))
    | exception Sys_error why -> Error (Error.Unavailable why)
