open Cmdliner

let run megabytes =
  Dolphin_console.Worker.main ~megabytes;
  Exit_status.Done

let megabytes =
  let doc = "Limit memory to $(docv) megabytes." in
  Arg.(value & opt int Dolphin_console.Worker_pool.limits.megabytes & info [ "megabytes" ] ~docv:"N" ~doc)

(* Not listed: $(b,dolphin console) starts it. *)
let command =
  let doc = "compute for $(b,dolphin console), in a process beside it" in
  Cmd.v (Cmd.info "console-worker" ~docs:Manpage.s_none ~doc) Term.(const run $ megabytes)
