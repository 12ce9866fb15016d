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

let lines path =
  let channel = open_in_bin path in
  let rec go read = match input_line channel with line -> go (line :: read) | exception End_of_file -> List.rev read in
  Fun.protect ~finally:(fun () -> close_in_noerr channel) (fun () -> go [])

(* A torn last line is of an order that was not carried out. *)
let rec orders = function
  | [] -> Ok []
  | [ last ] -> (match read_line last with Ok one -> Ok [ one ] | Error _ -> Ok [])
  | line :: later ->
    let* one = read_line line in
    let* later = orders later in
    Ok (one :: later)

let read path =
  match lines path with
  | exception Sys_error why -> Error why
  | [] -> Ok None
  | first :: later ->
    let* began = read_beginning first in
    let* later = orders later in
    Ok (Some (began, later))

let append path = open_out_gen [ Open_append; Open_creat; Open_binary ] 0o666 path

let open_ path =
  let told why = Printf.sprintf "%s: this is not the state of a simulated fleet: %s" path why in
  let* past = if Sys.file_exists path then Result.map_error told (read path) else Ok None in
  match append path with
  | exception Sys_error why -> Error why
  | channel -> (
      match past with
      | Some (began, orders) -> Ok (channel, began, orders)
      | None ->
        let began = Unix.gettimeofday () in
        write channel (`Assoc [ ("began", `Float began) ]);
        Ok (channel, began, []))

let add channel ~time order = write channel (`Assoc [ ("time", `Float time); ("order", Order.to_json order) ])
