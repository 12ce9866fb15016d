open Dolphin_json
open Lwt.Infix
open Exchange
module Scenario = Dolphin_scenario.Scenario

let longest = 20.
let most_bytes = 4 * 1024 * 1024
let most_waiting = 10

(* {1 What vehicles know} *)

let known (s : Scenario.t) : json =
  let of_vehicle (v : Scenario.vehicle) : json =
    let names = List.filter_map (fun (p : Scenario.plan) -> if Scenario.knows p v then Some p.name else None) s.plans in
    `Assoc [ ("vehicle", `String v.id); ("knows", Field.texts names) ]
  in
  `List (List.map of_vehicle s.vehicles)

(* {1 What the program gives them} *)

(* At most [most_bytes], and one. *)
let rec read_all channel buffer =
  Lwt_io.read ~count:65536 channel >>= function
  | "" -> Lwt.return_unit
  | text ->
    Buffer.add_string buffer text;
    if Buffer.length buffer > most_bytes then Lwt.return_unit else read_all channel buffer

let printed dolphin arguments =
  let buffer = Buffer.create 4096 in
  let command = (dolphin, Array.of_list (dolphin :: arguments)) in
  let read process =
    Lwt.finalize (fun () -> read_all process#stdout buffer) (fun () -> process#kill Sys.sigkill; Lwt.return_unit) in
  Lwt.catch
    (fun () -> Lwt_process.with_process_in ~timeout:longest ~stdin:`Dev_null ~stderr:`Dev_null command read)
    (function Lwt_io.Channel_closed _ | Unix.Unix_error _ | Sys_error _ -> Lwt.return_unit | e -> Lwt.fail e)
  >|= fun () -> Buffer.contents buffer

let no_plans why = refuse 422 "no-plans" why

let of_text ~vehicles text =
  if String.length text > most_bytes then no_plans "the program has too many plans to show"
  else
    match Yojson.Safe.from_string text with
    | `Assoc found -> Ok (`Assoc (("vehicles", vehicles) :: found))
    | _ | (exception Yojson.Json_error _) ->
      no_plans (Printf.sprintf "dolphin plan has found none, or takes more than %.0f seconds" longest)

let processes = Lwt_pool.create 1 (fun () -> Lwt.return_unit)

let order h found =
  let* path = get Field.text "program" found in
  let* named = optional Field.text "fleet" found in
  let* set = set found in
  let* program = program h ~set path in
  let* fleet = fleet h ~program:program.path named in
  let* program = within fleet program in
  if Lwt_pool.wait_queue_length processes >= most_waiting then refuse 503 "too-many" "too many ask for plans"
  else Ok (program, fleet)

let list h found =
  match order h found with
  | Error r -> Lwt.return (Error r)
  | Ok (program, fleet) ->
    let dolphin = (Hall.settings h).dolphin in
    let ask () = printed dolphin ("plan" :: "--json" :: Analysis.inputs program fleet) in
    Lwt_pool.use processes ask >|= of_text ~vehicles:(known fleet.scenario)
