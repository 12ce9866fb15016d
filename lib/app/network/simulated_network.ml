module Network = Dolphin_sim_imc.Network
module Scenario = Dolphin_scenario.Scenario

let ( let* ) = Result.bind

exception Broken of string

(* It may be read while it grows: each line is written at once. *)
let open_log = function
  | None -> Ok (ignore, fun () -> ())
  | Some path -> (
      let broken why = raise (Broken ("the log cannot be written: " ^ Text_file.named path why)) in
      match open_out path with
      | channel ->
        let write json =
          try
            output_string channel (Dolphin_json.Canonical.to_string json ^ "\n");
            flush channel
          with Sys_error why -> broken why
        in
        Ok (write, fun () -> close_out_noerr channel)
      | exception Sys_error why -> Error (Error.Unavailable ("the log cannot be written: " ^ Text_file.named path why)))

let missing (s : Network.settings) =
  let exists name = List.exists (fun (v : Scenario.vehicle) -> v.id = name) s.scenario.vehicles in
  let named = List.map fst s.refuses @ List.map fst (s.blocks @ s.vanishes) in
  List.find_opt (fun name -> not (exists name)) named

let live network interruption ~log lasts =
  let over = Option.fold ~none:(fst (Lwt.wait ())) ~some:Lwt_unix.sleep lasts in
  Lwt_main.run (Network.run ~log ~until:(Lwt.pick [ Interruption.promise interruption; over ]) network)

let run settings interruption ~log ~lasts ~started =
  let* () =
    match missing settings with
    | Some name -> Error (Error.Bad_input (Printf.sprintf "the fleet has no vehicle '%s'" name))
    | None -> Ok ()
  in
  let* log, close_log = open_log log in
  Fun.protect ~finally:close_log (fun () ->
      match Network.create settings with
      | Error why -> Error (Error.Unavailable why)
      | Ok network ->
        List.iter started (Network.vehicles network);
        let live () = live network interruption ~log lasts in
        match Fun.protect ~finally:(fun () -> Network.close network) live with
        | () -> Ok ()
        | exception Broken why -> Error (Error.Unavailable why))
