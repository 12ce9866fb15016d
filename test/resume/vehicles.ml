open Dolphin_scenario
module Network = Dolphin_sim_imc.Network

let speed = 40.

let scenario =
  match Scenario.read ~file:"mission.fleet" Mission.fleet with
  | Ok scenario -> scenario
  | Error _ -> failwith "the fleet of the kill tests is wrong"

let live ~port ~log =
  let settings =
    { (Network.default scenario) with
      speed; announce_period = 0.2; contact_period = 0.05; first_port = port + 5; discovery_ports = (port, port + 4) }
  in
  match Network.create settings with
  | Error why -> failwith why
  | Ok network ->
    let channel = open_out log in
    let write json =
      output_string channel (Yojson.Safe.to_string json ^ "\n");
      flush channel
    in
    Lwt_main.run (Network.run ~log:write ~until:(fst (Lwt.wait ())) network);
    0

let start ~port ~log = Processes.fork (fun () -> live ~port ~log)

(* {1 Their log} *)

let deeds log =
  let channel = open_in log in
  let rec read found =
    match input_line channel with
    | line -> read (Yojson.Safe.from_string line :: found)
    | exception End_of_file -> close_in channel; List.rev found
  in
  read []

let member name json = match Yojson.Safe.Util.member name json with `String text -> Some text | _ -> None

let started log =
  let plan deed = if member "did" deed = Some "started" then member "plan" deed else None in
  List.filter_map plan (deeds log)

let faults log =
  let is_fault deed =
    match member "did" deed with
    | Some "started" -> member "instead" deed <> None
    | Some "completed" -> false
    | Some "stopped" -> (match member "stopped" deed with None -> false | Some plan -> plan <> Mission.stopped)
    | Some _ | None -> true
  in
  List.map (fun deed -> Yojson.Safe.to_string deed) (List.filter is_fault (deeds log))
