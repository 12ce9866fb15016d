open Cmdliner

let s_platforms = "PLATFORMS"

let adapters =
  let doc =
    "Run on the vehicles that the command $(docv) speaks for: an adapter, a process that speaks the platform protocol \
     on its standard streams. It is given to $(b,/bin/sh). May be repeated, and beside $(b,--imc); a vehicle is \
     commanded by the platform that offers it. $(i,docs/platform.md) tells more."
  in
  Arg.(value & opt_all string [] & info [ "platform" ] ~docs:s_platforms ~docv:"CMD" ~doc)
