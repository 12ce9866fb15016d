open Dolphin_semantics
module Scenario = Dolphin_scenario.Scenario

let call ~called scenario =
  let times = Hashtbl.create 8 in
  let count call = Option.value (Hashtbl.find_opt times call) ~default:0 in
  let note call = Hashtbl.replace times call (count call + 1) in
  List.iter note called;
  fun ~site ~subject ~member ~arguments:_ ->
    let call = Machine.name_of_call ~subject ~member in
    let reply =
      match Scenario.reply scenario call (count call) with
      | Some reply -> Result.map (Value.made_at site) reply
      | None ->
        let why = "there is no host process to call: name one with --supplier, or give the fleet a reply" in
        Error (Printf.sprintf "%s '%s'" why call)
    in
    note call;
    Lwt.return reply
