type ending = Exited of int | Killed of int | Not_started of string

(* Seconds. *)
let between_looks = 0.1
let patience = 3.

let rec wait pid =
  match Unix.waitpid [] pid with
  | _, WEXITED status -> Exited status
  | _, (WSIGNALED signal | WSTOPPED signal) -> Killed signal
  | exception Unix.Unix_error (EINTR, _, _) -> wait pid

let kill pid signal = try Unix.kill pid signal with Unix.Unix_error _ -> ()

(* Calls [line] for each whole line of [input], and gives the text after the last one. *)
let take_lines line pending chunk n =
  let rec go start =
    match Bytes.index_from_opt chunk start '\n' with
    | Some i when i < n ->
      Buffer.add_subbytes pending chunk start (i - start);
      let text = Buffer.contents pending in
      Buffer.clear pending;
      line text;
      go (i + 1)
    | Some _ | None -> Buffer.add_subbytes pending chunk start (n - start)
  in
  go 0

let read_all ~interrupted ~pid line input =
  let chunk = Bytes.create 65536 and pending = Buffer.create 1024 in
  let rec go told =
    let told =
      match told with
      | None when interrupted () ->
        kill pid Sys.sigterm;
        Some (Unix.gettimeofday ())
      | Some since when Unix.gettimeofday () -. since > patience ->
        kill pid Sys.sigkill;
        told
      | None | Some _ -> told
    in
    match Unix.select [ input ] [] [] between_looks with
    | [], _, _ -> go told
    | _ :: _, _, _ -> (
        match Unix.read input chunk 0 (Bytes.length chunk) with
        | 0 -> if Buffer.length pending > 0 then line (Buffer.contents pending)
        | n ->
          take_lines line pending chunk n;
          go told)
    | exception Unix.Unix_error (EINTR, _, _) -> go told
  in
  go None

(* A child begins in its parent's directory, so the parent goes there for that moment. *)
let start directory argv output =
  let nothing = Unix.openfile "/dev/null" [ O_RDONLY; O_CLOEXEC ] 0 and here = Sys.getcwd () in
  let back () =
    Unix.close nothing;
    Unix.chdir here
  in
  Fun.protect ~finally:back (fun () ->
      Unix.chdir directory;
      Unix.create_process (List.hd argv) (Array.of_list argv) nothing output output)

let run ?(directory = Filename.current_dir_name) ~interrupted line argv =
  let input, output = Unix.pipe ~cloexec:true () in
  match start directory argv output with
  | exception Unix.Unix_error (error, _, _) ->
    Unix.close input;
    Unix.close output;
    Not_started (Unix.error_message error)
  | pid -> (
      Unix.close output;
      match read_all ~interrupted ~pid line input with
      | () ->
        Unix.close input;
        wait pid
      | exception error ->
        Unix.close input;
        kill pid Sys.sigkill;
        ignore (wait pid);
        raise error)
