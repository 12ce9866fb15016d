open Cmdliner
open Dolphin_app
module Safe_print = Dolphin_display.Safe_print
module Network = Dolphin_sim_imc.Network
module Server = Dolphin_sim_process.Fleet_process
module Scenario = Dolphin_scenario.Scenario

let tell_vehicle ({ name; kind; id; port } : Network.vehicle) =
  Safe_print.format "%s (%s): IMC system 0x%04X, UDP port %d@." name kind id port

let serve (settings : Scenario.t -> Network.settings) ~log lasts (fleet : Fleet_file.t) =
  let interruption = Interruption.make () in
  Interruption.on_signals ~again:Exit_status.exit_interrupted interruption;
  let status () : Exit_status.t = if Interruption.happened interruption then Interrupted else Done in
  Result.map status
    (Simulated_network.run (settings fleet.scenario) interruption ~log ~lasts ~started:tell_vehicle)

(* Behind the platform protocol: everything on standard output is a report. *)
let adapt (settings : Scenario.t -> Network.settings) ~state (fleet : Fleet_file.t) =
  let { Network.seed; speed; _ } = settings fleet.scenario in
  match Lwt_main.run (Server.run { scenario = fleet.scenario; seed; speed; state }) with
  | Ok () -> Ok Exit_status.Done
  | Error why -> Error (Error.Bad_input why)

type asked = {
  fleet : string option;
  imc : bool;
  platform : bool;
  state : string option;
  log : string option;
  lasts : float option;  (* seconds *)
  settings : Scenario.t -> Network.settings;
}

let run { fleet; imc; platform; state; log; lasts; settings } =
  let bad why = Report.error (Error.Bad_input why) in
  match imc, platform with
  | true, true -> bad "--imc and --platform exclude each other: give one of them"
  | false, false -> bad "give --imc or --platform, the protocol of the simulated vehicles"
  | true, false when state <> None -> bad "--state goes with --platform"
  | true, false -> Report.result (Result.bind (Fleet_file.load fleet) (serve settings ~log lasts))
  | false, true when log <> None || lasts <> None -> bad "--log and --for go with --imc"
  | false, true -> Report.result (Result.bind (Fleet_file.load fleet) (adapt settings ~state))

(* {1 The command line} *)

let fleet =
  let doc = "The fleet, a file such as $(i,mission.fleet). The default is the built-in fleet." in
  Arg.(value & pos 0 (some string) None & info [] ~docv:"FLEET" ~doc)

let imc = Arg.(value & flag & info [ "imc" ] ~doc:"Speak IMC over UDP.")

let platform =
  let doc =
    "Speak the platform protocol on standard input and output, as an adapter of $(mname) $(b,exec --platform) does."
  in
  Arg.(value & flag & info [ "platform" ] ~doc)

let state =
  let doc =
    "With $(b,--platform): store the fleet's orders in the file $(docv), so that the fleet outlives this process: the \
     next process with this file finds the vehicles where they would be by then. The fleet file, the seed and the \
     speed must be the same."
  in
  Arg.(value & opt (some string) None & info [ "state" ] ~docv:"FILE" ~doc)

let log_file =
  let doc =
    "Write the orders to each vehicle and its reactions to the file $(docv), a JSON object a line: $(b,time), \
     $(b,vehicle), $(b,did) ($(b,started), $(b,refused), $(b,stopped), $(b,completed), $(b,failed), ...), $(b,plan), \
     $(b,request_id), $(b,by), $(b,sent)."
  in
  Arg.(value & opt (some string) None & info [ "log" ] ~docv:"FILE" ~doc)

let lasts =
  let doc = "End after $(docv) seconds. By default Ctrl-C ends it." in
  Arg.(value & opt (some Sim_options.natural) None & info [ "for" ] ~docv:"SECONDS" ~doc)

let asked =
  let open Options.Syntax in
  let+ fleet = fleet
  and+ imc = imc
  and+ platform = platform
  and+ state = state
  and+ log = log_file
  and+ lasts = lasts
  and+ settings = Sim_options.settings in
  { fleet; imc; platform; state; log; lasts; settings }

let man =
  [ `S Manpage.s_description;
    `P "$(tname) puts the vehicles of a fleet file on the network. Each is a system that speaks IMC over UDP as a \
        vehicle with DUNE does: it announces itself, sends its state to consoles, takes plans and runs them. The \
        fleet file defines how plans end, and when vehicles join, lose their link and leave.";
    `P "When all vehicles can be found, a line for each is printed: its name, type, number and port. They go on until \
        Ctrl-C, or for the time given by $(b,--for).";
    `P "With $(b,--platform) the vehicles are not on a network: $(tname) is an adapter, and standard input and output \
        are its streams. See $(i,docs/platform.md).";
    `S Manpage.s_arguments;
    `S Manpage.s_options;
    `S Sim_options.faults_section;
    `P "Faults of links affect each datagram independently. The same seed gives the same faults, as far as the \
        datagrams are the same.";
    `S Sim_options.network_section;
    `S Manpage.s_exit_status;
    `S Manpage.s_examples;
    `P "A fleet at ten times its speed, on a bad link:";
    `Pre "  $(mname) $(tname) examples/rendezvous.fleet --imc --speed 10 --loss 0.3 --duplication 0.1 \
          --reordering 0.2";
    `P "A program on a fleet behind the platform protocol:";
    `Pre "  $(mname) exec examples/rendezvous.dol --answer 2 \\\\\n    \
          --platform '$(mname) $(tname) examples/rendezvous.fleet --platform --speed 60'" ]
  @ Options.see_also

let command =
  let info =
    Cmd.info "sim" ~docs:Options.s_run ~doc:"put simulated vehicles on the network" ~man
      ~exits:(Options.exits [ Done; Bad_input; Platform_trouble; Bug; Interrupted ])
  in
  Cmd.v info Term.(const run $ asked)
