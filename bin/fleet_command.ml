open Cmdliner
open Dolphin_app

let ( let* ) = Result.bind

type asked = {
  network : Dolphin_platform_imc.Udp_platform.options;
  adapters : string list;
  definition : string option;
  as_json : bool;
  once : bool;
  seconds : float option;
}

let run { network; adapters; definition; as_json; once; seconds } =
  Report.result
    (let* definition = Definition_file.load definition in
     let options = Imc_options.with_names definition network in
     let interruption = Interruption.make () in
     Interruption.on_signals ~again:Exit_status.exit_interrupted interruption;
     let* () =
       if adapters <> [] then Adapter_view.run adapters interruption ~as_json ~once ~seconds
       else Network_view.run options definition interruption ~as_json ~once ~seconds
     in
     Ok Exit_status.Done)

let as_json =
  let doc = "Print JSON: an array with an object for each system, on one line; without $(b,--once), each second." in
  Arg.(value & flag & info [ "json" ] ~doc)

let once =
  let doc = "Print the vehicles found once, after $(b,--seconds), as without a terminal." in
  Arg.(value & flag & info [ "once" ] ~doc)

let seconds =
  let positive = Options.number ~docv:"SECONDS" "a number of seconds" (fun x -> x > 0. && x < infinity) in
  let doc =
    "Look for $(docv) seconds. By default until Ctrl-C, and with $(b,--once) for 16 seconds: by then every vehicle \
     with the usual settings has announced itself and spoken to us."
  in
  Arg.(value & opt (some positive) None & info [ "seconds" ] ~docv:"SECONDS" ~doc)

let asked =
  let open Options.Syntax in
  let+ () = Verbosity.setup
  and+ network = Imc_options.options
  and+ adapters = Platform_options.looking
  and+ definition = Imc_options.definition
  and+ as_json = as_json
  and+ once = once
  and+ seconds = seconds in
  { network; adapters; definition; as_json; once; seconds }

let man =
  [ `S Manpage.s_description;
    `P "$(tname) listens for systems that speak IMC over UDP and shows them: their names as programs pick them, \
        types, addresses, positions, modes, batteries, payload, the running plan, and the time since they were last \
        heard. Programs can pick those in mode SERVICE.";
    `P "It introduces itself to vehicles as a console does, since they would not send to it otherwise. It requests \
        nothing but their lists of entities.";
    `P "With $(b,--json) and $(b,--imc-xml) each system has $(b,messages) too: an object for each kind of message \
        that it sends, with its number ($(b,id)), the number received ($(b,count)) and the content of the last one.";
    `P "With $(b,--platform) it shows the vehicles of adapters instead, and orders nothing.";
    `S Manpage.s_options;
    `S Imc_options.s_network;
    `S Manpage.s_exit_status;
    `S Manpage.s_examples;
    `Pre "  $(mname) $(tname)\n  $(mname) $(tname) --once --json | jq '.[].id'";
    `S Manpage.s_see_also;
    `P "If no vehicle is found, see $(i,docs/imc.md)." ]

let command =
  let info =
    Cmd.info "fleet" ~docs:Options.s_run ~doc:"show the vehicles of the network" ~man
      ~exits:(Options.exits [ Done; Bad_input; Platform_trouble; Bug ])
  in
  Cmd.v info Term.(const run $ asked)
