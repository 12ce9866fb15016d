(* "x.dol: No such file or directory" if opening fails, "Is a directory" if reading does. *)
let named path why =
  let n = String.length path in
  if String.length why > n && String.sub why 0 n = path then why else path ^ ": " ^ why

let bad path why = Error (Error.Bad_input (named path why))

(* No program or fleet is larger: a larger file was named by mistake. *)
let most_bytes = 64 * 1024 * 1024

let read_all path channel =
  let contents = Buffer.create 65536 and chunk = Bytes.create 65536 in
  let rec go () =
    let n = input channel chunk 0 (Bytes.length chunk) in
    Buffer.add_subbytes contents chunk 0 n;
    if Buffer.length contents > most_bytes then bad path "the file is larger than 64 MB"
    else if n = 0 then Ok (Buffer.contents contents)
    else go ()
  in
  go ()

let with_channel path f =
  let read () =
    let channel = open_in_bin path in
    Fun.protect ~finally:(fun () -> close_in_noerr channel) (fun () -> f channel)
  in
  match read () with result -> result | exception Sys_error why -> bad path why

let read path =
  if path = "" then Error (Error.Bad_input "the name of the file is empty")
  else if Sys.file_exists path && Sys.is_directory path then bad path "this is a directory, not a file"
  else with_channel path (read_all path)

let anything _ = Ok ()

let read_named ~may_read path =
  let text () = Result.map_error (fun e -> String.concat "; " (Error.sentences e)) (read path) in
  Result.bind (may_read path) text

let read_input () =
  match read_all "standard input" stdin with
  | result -> result
  | exception Sys_error why -> bad "standard input" why

let check path =
  let unavailable why = Error (Error.Unavailable (Printf.sprintf "%s: %s" path why)) in
  let writable place rights =
    match Unix.access place rights with
    | () -> Ok ()
    | exception Unix.Unix_error (error, _, _) -> unavailable (Unix.error_message error)
  in
  match Sys.is_directory path with
  | true -> unavailable "this is a directory, not a file"
  | false -> writable path [ W_OK ]
  | exception Sys_error _ -> writable (Filename.dirname path) [ W_OK; X_OK ]

let filled channel f = Fun.protect ~finally:(fun () -> close_out_noerr channel) (fun () -> f channel; close_out channel)

(* The permissions of a new file, as [open_out] gives them. *)
let usual_permissions () =
  let mask = Unix.umask 0 in
  ignore (Unix.umask mask);
  0o666 land lnot mask

(* A file that is written under another name, or not yet at all. *)
type prepared = { commit : unit -> unit; abandon : unit -> unit }

let replacement path ~permissions f =
  (* An error that follows would name the temporary file. *)
  Unix.access (Filename.dirname path) [ W_OK; X_OK ];
  let temporary, channel =
    Filename.open_temp_file ~mode:[ Open_binary ] ~temp_dir:(Filename.dirname path) ".dolphin" "" in
  let abandon () = try Sys.remove temporary with Sys_error _ -> () in
  match filled channel f; Unix.chmod temporary permissions with
  | () -> { commit = (fun () -> Sys.rename temporary path); abandon }
  | exception error -> abandon (); raise error

(* Who may read a command may run it. *)
let rights ~is_command permissions =
  if is_command then permissions lor ((permissions land 0o444) lsr 2) else permissions

(* A link stays a link, to a file with the permissions that it had. *)
let prepare ?(is_command = false) path f =
  match Unix.stat path with
  | { st_kind = S_REG; st_perm; _ } -> replacement (Unix.realpath path) ~permissions:(rights ~is_command st_perm) f
  | { st_kind = S_DIR; _ } -> raise (Unix.Unix_error (EISDIR, "open", path))
  | { st_kind = S_CHR | S_BLK | S_LNK | S_FIFO | S_SOCK; _ } ->
    { commit = (fun () -> filled (open_out_bin path) f); abandon = ignore }
  | exception Unix.Unix_error (ENOENT, _, _) ->
    replacement path ~permissions:(rights ~is_command (usual_permissions ())) f

let saved path f =
  match f () with
  | () -> Ok ()
  | exception Sys_error why -> Error (Error.Unavailable (named path why))
  | exception Unix.Unix_error (error, _, _) -> Error (Error.Unavailable (path ^ ": " ^ Unix.error_message error))

let commit prepared = try prepared.commit () with error -> prepared.abandon (); raise error
let write path f = saved path (fun () -> commit (prepare path f))

(* {1 Several files} *)

type file = { name : string; text : string; is_command : bool }

let rec make_folder ~made path =
  if Sys.file_exists path then Ok ()
  else
    Result.bind (make_folder ~made (Filename.dirname path)) (fun () ->
        saved path (fun () ->
            Unix.mkdir path 0o777;
            made := path :: !made))

let write_all folder files =
  let made = ref [] and prepared = ref [] in
  let prepare_one { name; text; is_command } =
    let path = Filename.concat folder name in
    Result.bind (make_folder ~made (Filename.dirname path)) (fun () ->
        saved path (fun () ->
            prepared := (path, prepare ~is_command path (fun channel -> output_string channel text)) :: !prepared))
  in
  let commit_one (path, file) = saved path (fun () -> commit file) in
  let each f xs = List.fold_left (fun result x -> Result.bind result (fun () -> f x)) (Ok ()) xs in
  let written = Result.bind (each prepare_one files) (fun () -> each commit_one (List.rev !prepared)) in
  if Result.is_error written then begin
    List.iter (fun (_, file) -> file.abandon ()) !prepared;
    List.iter (fun path -> try Unix.rmdir path with Unix.Unix_error _ -> ()) !made
  end;
  written
