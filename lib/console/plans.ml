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

(* {1 The command} *)

let prepare w found =
  let* path = get Field.text "program" found in
  let* named = optional Field.text "fleet" found in
  let* set = set found in
  let* program, fleet = Workspace.program_in_fleet w ~set ~fleet:named path in
  Ok
    (`Assoc
       [ ("arguments", Field.texts ("plan" :: "--json" :: Analysis.inputs program fleet));
         ("vehicles", known fleet.scenario) ])

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

(* The text is not parsed here. One that was cut off does not end like this. *)
let is_whole text =
  let n = String.length text in
  n > 2 && text.[0] = '{' && text.[n - 2] = '}' && String.index text '\n' = n - 1

let of_text ~vehicles text =
  if String.length text > most_bytes then no_plans "the program has too many plans to show"
  else if is_whole text then
    let members = String.sub text 1 (String.length text - 1) in
    Ok (Printf.sprintf "{\"vehicles\":%s,%s" (Canonical.to_string vehicles) members)
  else no_plans (Printf.sprintf "dolphin plan has found none, or takes more than %.0f seconds" longest)

let processes = Lwt_pool.create 1 (fun () -> Lwt.return_unit)

let list ~dolphin prepared =
  let wanted =
    let* arguments = get (Field.list Field.text) "arguments" prepared in
    let* vehicles = get Field.any "vehicles" prepared in
    if Lwt_pool.wait_queue_length processes >= most_waiting then refuse 503 "too-many" "too many ask for plans"
    else Ok (arguments, vehicles)
  in
  match wanted with
  | Error r -> Lwt.return (Error r)
  | Ok (arguments, vehicles) ->
    Lwt_pool.use processes (fun () -> printed dolphin arguments) >|= of_text ~vehicles
