open Dolphin_syntax

let ( let* ) = Result.bind

let is_source path =
  List.exists (Filename.check_suffix path) [ ".dol"; ".dolphin"; ".fleet" ]

let is_hidden name = name = "" || name.[0] = '.' || name.[0] = '_'
let is_folder path = Sys.file_exists path && Sys.is_directory path

let rec below folder =
  match Sys.readdir folder with
  | exception Sys_error why -> Error (Error.Bad_input (Text_file.named folder why))
  | names ->
    let found reversed name =
      let* reversed = reversed in
      let path = if folder = "." then name else Filename.concat folder name in
      if is_hidden name then Ok reversed
      else if is_folder path then Result.map (fun paths -> List.rev_append paths reversed) (below path)
      else Ok (if is_source path then path :: reversed else reversed)
    in
    Result.map List.rev (Array.fold_left found (Ok []) (Array.of_list (List.sort compare (Array.to_list names))))

let all paths =
  let found reversed path =
    let* reversed = reversed in
    if is_folder path then Result.map (fun paths -> List.rev_append paths reversed) (below path)
    else Ok (path :: reversed)
  in
  Result.map List.rev (List.fold_left found (Ok []) paths)

let formatted ~file source =
  Result.map_error (fun found -> Error.Bad_text { source; found }) (Formatting.program ~file source)

(* A link stays a link, to a file with the permissions that it had. *)
let replace path text =
  let write () =
    let path = Unix.realpath path in
    let permissions = (Unix.stat path).st_perm in
    let temporary, channel =
      Filename.open_temp_file ~mode:[ Open_binary ] ~temp_dir:(Filename.dirname path) ".dolphin-fmt" "" in
    match
      Fun.protect ~finally:(fun () -> close_out_noerr channel) (fun () ->
          output_string channel text;
          close_out channel);
      Unix.chmod temporary permissions;
      Sys.rename temporary path
    with
    | () -> ()
    | exception error -> (try Sys.remove temporary with Sys_error _ -> ()); raise error
  in
  match write () with
  | () -> Ok ()
  | exception Sys_error why -> Error (Error.Unavailable (Text_file.named path why))
  | exception Unix.Unix_error (code, _, _) -> Error (Error.Unavailable (path ^ ": " ^ Unix.error_message code))
