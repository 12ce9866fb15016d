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

(* A link stays a link, to a file with the permissions that it had. *)
let replace path ~permissions f =
  (* An error that follows would name the temporary file. *)
  Unix.access (Filename.dirname path) [ W_OK; X_OK ];
  let temporary, channel =
    Filename.open_temp_file ~mode:[ Open_binary ] ~temp_dir:(Filename.dirname path) ".dolphin" "" in
  match
    filled channel f;
    Unix.chmod temporary permissions;
    Sys.rename temporary path
  with
  | () -> ()
  | exception error -> (try Sys.remove temporary with Sys_error _ -> ()); raise error

let write path f =
  let save () =
    match Unix.stat path with
    | { st_kind = S_REG; st_perm; _ } -> replace (Unix.realpath path) ~permissions:st_perm f
    | { st_kind = S_DIR | S_CHR | S_BLK | S_LNK | S_FIFO | S_SOCK; _ } -> filled (open_out_bin path) f
    | exception Unix.Unix_error (ENOENT, _, _) -> replace path ~permissions:(usual_permissions ()) f
  in
  match save () with
  | () -> Ok ()
  | exception Sys_error why -> Error (Error.Unavailable (named path why))
  | exception Unix.Unix_error (error, _, _) -> Error (Error.Unavailable (path ^ ": " ^ Unix.error_message error))
