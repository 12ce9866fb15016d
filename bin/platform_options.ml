open Cmdliner
open Dolphin_app

let s_platforms = "PLATFORMS"

let checking =
  let doc =
    "Ask the adapter that the command $(docv) starts for problems that keep its vehicles from running the plans; \
     nothing moves. May be repeated: a plan is fine if one of them can run it. See $(i,docs/platform.md)."
  in
  Arg.(value & opt_all string [] & info [ "platform" ] ~docv:"CMD" ~doc)

let looking =
  let doc = "Show the vehicles of the adapter $(docv), not those that speak IMC. May be repeated." in
  Arg.(value & opt_all string [] & info [ "platform" ] ~docv:"CMD" ~doc)

let adapters =
  let doc =
    "Run on the vehicles of the command $(docv): an adapter, a process that speaks the platform protocol on its \
     standard streams. It is given to $(b,/bin/sh). May be repeated, and combined with $(b,--imc); a vehicle is \
     commanded by the platform that offers it. See $(i,docs/platform.md)."
  in
  Arg.(value & opt_all string [] & info [ "platform" ] ~docs:s_platforms ~docv:"CMD" ~doc)

let ask adapters plans =
  let interruption = Interruption.make () in
  Interruption.on_signals ~again:Exit_status.exit_interrupted interruption;
  Adapter_check.ask interruption adapters plans
