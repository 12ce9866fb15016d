open Dolphin_semantics
open Dolphin_runtime
module Scenario = Dolphin_scenario.Scenario

let console scenario =
  let asked = Hashtbl.create 4 and refused = Hashtbl.create 4 and latest = ref ("", "") in
  let ask prompt =
    let n = Option.value (Hashtbl.find_opt asked prompt) ~default:0 in
    Hashtbl.replace asked prompt (n + 1);
    Lwt.return
      (match Scenario.answer scenario prompt n with
       | None -> Error "none is given"
       | Some text when Hashtbl.mem refused (prompt, text) -> Error "it was refused"
       | Some text -> latest := (prompt, text); Ok text)
  in
  { Console.say = ignore; ask; refused = (fun _ -> Hashtbl.replace refused !latest ()) }

let host scenario =
  let called = Hashtbl.create 4 in
  fun ~site ~subject ~member ~arguments:_ ->
    let call = Machine.name_of_call ~subject ~member in
    let n = Option.value (Hashtbl.find_opt called call) ~default:0 in
    Hashtbl.replace called call (n + 1);
    match Scenario.reply scenario call n with
    | Some reply -> Lwt.return (Result.map (Value.made_at site) reply)
    | None -> Lwt.return (Error (Dolphin_environment.Environment.no_reply call))
