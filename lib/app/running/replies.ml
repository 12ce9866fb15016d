open Dolphin_semantics
open Dolphin_runtime
module Scenario = Dolphin_scenario.Scenario
module Reply = Dolphin_scenario.Reply

(* The scenario's reply to a call, this time, after the calls before. *)
let in_turn scenario =
  let times = Hashtbl.create 8 in
  fun call ->
    let n = Option.value (Hashtbl.find_opt times call) ~default:0 in
    Hashtbl.replace times call (n + 1);
    Scenario.reply scenario call n

let call ~past scenario =
  let next = in_turn scenario in
  let count = function call, Some _ -> ignore (next call : Reply.t option) | _, None -> () in
  List.iter count (History.replies past);
  fun ~site ~subject ~member ~arguments:_ ->
    let call = Machine.name_of_call ~subject ~member in
    match next call with
    | Some reply -> Lwt.return (Result.map (Value.made_at site) reply)
    | None ->
      let why = "no host process to call: name one with --supplier, or give the fleet a reply" in
      Lwt.return (Error (Format.asprintf "%s %a" why Value.pp (String call)))

let are_of scenario history =
  let next = in_turn scenario in
  let is_of (call, reply) =
    match next call, reply with
    | None, _ -> false
    | Some _, None -> true
    | Some known, Some given -> Reply.equal known (Result.map (Value.made_at Fault.unknown_site) given)
  in
  List.for_all is_of (History.replies history)
