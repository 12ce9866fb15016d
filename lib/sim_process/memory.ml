open Dolphin_json.Field
module Order = Dolphin_platform_protocol.Order

type t = out_channel

let write channel json =
  output_string channel (Dolphin_json.Canonical.to_string json ^ "\n");
  flush channel

let read_line text =
  let* line = members (try Yojson.Safe.from_string text with Yojson.Json_error _ -> `Null) in
  let* time = get number "time" line in
  let* order = get any "order" line in
  let* order = Order.of_line (Dolphin_json.Canonical.to_string order) in
  match order with Some order -> Ok (time, order) | None -> Error "an order that is not known"

let read_beginning text =
  let* line = members (try Yojson.Safe.from_string text with Yojson.Json_error _ -> `Null) in
  get number "began" line

(* The lines that end, and the length of the text up to there. A line is written with its end: one without is torn, and
   its order was not carried out. *)
let whole_lines text =
  match String.rindex_opt text '\n' with
  | None -> ([], 0)
  | Some last -> (String.split_on_char '\n' (String.sub text 0 last), last + 1)

let contents path =
  let channel = open_in_bin path in
  let read () = really_input_string channel (in_channel_length channel) in
  Fun.protect ~finally:(fun () -> close_in_noerr channel) read

(* The beginning and the orders, if there are any, and the length of what they were read from. *)
let read path =
  match whole_lines (contents path) with
  | [], _ -> Ok (None, 0)
  | first :: later, length ->
    let* began = read_beginning first in
    let* orders = Dolphin_results.Results.map read_line later in
    Ok (Some (began, orders), length)

(* What follows a torn line is on a line of its own. *)
let append path ~length =
  let descriptor = Unix.openfile path [ O_WRONLY; O_APPEND; O_CREAT; O_CLOEXEC ] 0o666 in
  if (Unix.fstat descriptor).st_size > length then Unix.ftruncate descriptor length;
  Unix.out_channel_of_descr descriptor

let opened path =
  let no_state why = Printf.sprintf "%s: this is not the state of a simulated fleet: %s" path why in
  let is_file = (not (Sys.file_exists path)) || (Unix.stat path).st_kind = S_REG in
  let* () = if is_file then Ok () else Error (no_state "it is not a file") in
  let* past, length = if Sys.file_exists path then Result.map_error no_state (read path) else Ok (None, 0) in
  let channel = append path ~length in
  match past with
  | Some (began, orders) -> Ok (channel, began, orders)
  | None ->
    let began = Unix.gettimeofday () in
    write channel (`Assoc [ ("began", `Float began) ]);
    Ok (channel, began, [])

let open_ path =
  match opened path with
  | result -> result
  | exception Sys_error why -> Error (path ^ ": " ^ why)
  | exception Unix.Unix_error (error, _, _) -> Error (path ^ ": " ^ Unix.error_message error)

let add channel ~time order = write channel (`Assoc [ ("time", `Float time); ("order", Order.to_json order) ])
