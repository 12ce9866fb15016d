open Cmdliner
module Network = Dolphin_sim_imc.Network
module Scenario = Dolphin_scenario.Scenario

(* {1 Running} *)

let open_log = function
  | None -> Ok (ignore, ignore)
  | Some path -> (
      match open_out path with
      | channel ->
        let write json =
          output_string channel (Yojson.Safe.to_string json ^ "\n");
          flush channel
        in
        Ok (write, fun () -> close_out_noerr channel)
      | exception Sys_error why -> Error why)

let tell_vehicle ({ name; kind; id; port } : Network.vehicle) =
  Format.printf "%s (%s): IMC system 0x%04X, UDP port %d@." name kind id port

let live interruption network ~log lasts =
  let over = Option.fold ~none:(fst (Lwt.wait ())) ~some:Lwt_unix.sleep lasts in
  let until = Lwt.pick [ Interruption.promise interruption; over ] in
  Lwt_main.run (Network.run ~log ~until network);
  if Interruption.happened interruption then Exit_status.Interrupted else Done

let serve settings ~log_file lasts : Exit_status.t =
  match open_log log_file with
  | Error why -> Report.complain why; Bad_input
  | Ok (log, close_log) ->
    let interruption = Interruption.make () in
    Fun.protect ~finally:close_log (fun () ->
        match Network.create settings with
        | Error why -> Report.complain why; Exit_status.Platform_trouble
        | Ok network ->
          List.iter tell_vehicle (Network.vehicles network);
          Fun.protect ~finally:(fun () -> Network.close network) (fun () ->
              live interruption network ~log lasts))

(* {1 The command line} *)

let no_such_vehicle (scenario : Scenario.t) names =
  let exists name = List.exists (fun (v : Scenario.vehicle) -> v.id = name) scenario.vehicles in
  List.find_opt (fun name -> not (exists name)) names

let run fleet imc log_file lasts (settings : Scenario.t -> Network.settings) : Exit_status.t =
  if not imc then begin
    Report.complain "say --imc: IMC is the only protocol that simulated vehicles speak on a network";
    Bad_input
  end
  else
    match Fleet_file.load fleet with
    | Error trouble -> Fleet_file.tell trouble; Bad_input
    | Ok { scenario; path = _ } -> (
        let settings = settings scenario in
        let named = List.map fst settings.refuses @ List.map fst (settings.blocks @ settings.vanishes) in
        match no_such_vehicle scenario named with
        | Some name -> Report.complain (Printf.sprintf "the fleet has no vehicle '%s'" name); Bad_input
        | None -> serve settings ~log_file lasts)

let fleet =
  let doc = "The fleet, a file such as $(i,mission.fleet). The default is the built-in fleet." in
  Arg.(value & pos 0 (some string) None & info [] ~docv:"FLEET" ~doc)

let imc = Arg.(value & flag & info [ "imc" ] ~doc:"Speak IMC over UDP. Must be given: there is no other protocol yet.")

let log_file =
  let doc =
    "Write to the file $(docv) what each vehicle was commanded and did, a JSON object a line: $(b,time), $(b,vehicle), \
     $(b,did) ($(b,started), $(b,refused), $(b,stopped), $(b,completed), $(b,failed), ...), $(b,plan), \
     $(b,request_id), $(b,by), $(b,sent)."
  in
  Arg.(value & opt (some string) None & info [ "log" ] ~docv:"FILE" ~doc)

let lasts =
  let doc = "End after $(docv) seconds. By default Ctrl-C ends it." in
  Arg.(value & opt (some Sim_options.natural) None & info [ "for" ] ~docv:"SECONDS" ~doc)

let man =
  [ `S Manpage.s_description;
    `P "$(tname) puts the vehicles of a fleet file on the network. Each is a system that speaks IMC over UDP as a \
        vehicle with DUNE does: it announces itself, sends its state to consoles, takes plans and runs them. What \
        becomes of plans, when vehicles join, lose their link and leave, is as the fleet file says.";
    `P "When all vehicles can be found, a line for each is printed: its name, type, number and port. They go on until \
        Ctrl-C, or for the time given by $(b,--for).";
    `S Manpage.s_arguments;
    `S Manpage.s_options;
    `S Sim_options.faults_section;
    `P "What is wrong with links concerns each datagram by itself. The same seed gives the same faults, as far as the \
        datagrams are the same.";
    `S Sim_options.network_section;
    `S Manpage.s_exit_status;
    `S Manpage.s_examples;
    `P "A fleet whose missions take a tenth of their time, on a bad link:";
    `Pre "  $(mname) $(tname) examples/rendezvous.fleet --imc --speed 10 --loss 0.3 --duplication 0.1 \
          --reordering 0.2" ]
  @ Options.see_also

let command =
  let info =
    Cmd.info "sim" ~doc:"put simulated vehicles on the network" ~man
      ~exits:(Options.exits [ Done; Bad_input; Platform_trouble; Bug; Interrupted ])
  in
  Cmd.v info Term.(const run $ fleet $ imc $ log_file $ lasts $ Sim_options.settings)
