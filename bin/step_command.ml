open Cmdliner

let run () =
  set_binary_mode_in stdin true;
  Dolphin_app.Oracle_server.serve ~name:("dolphin " ^ Version.number) stdin stdout;
  Exit_status.Done

let man =
  [ `S Manpage.s_description;
    `P "$(tname) answers questions about the semantics on its standard input, in lines of JSON. For a program and a \
        fleet it returns the initial configuration; for a configuration, all its transitions, each with its rules, \
        label, effects and next configuration. A configuration can be stored, compared, and sent at any time: only \
        the program given last is remembered.";
    `P "So another implementation can be compared with this one, and tools can walk through a program's runs without \
        OCaml. $(i,conformance/INTERPRETING.md) describes the protocol; $(mname) $(b,conform) speaks it to others.";
    `S Manpage.s_examples;
    `Pre "  \\$ $(mname) $(tname)\n\
         \  {\"request\":\"initial\",\"program\":\"post a: 1\",\"fleet\":\"\"}\n\
         \  {\"configuration\":{\"control\":\"script\",\"end\":null,\"A\":{},\"B\":[],\"N\":[],...},\"world\":[]}\n\
         \  {\"request\":\"step\",\"configuration\":...}\n\
         \  {\"transitions\":[{\"rule\":[\"POST\"],\"label\":\"post a:1\",...,\"next\":...}],\"awaited\":...}" ]
  @ Options.see_also

let command =
  let info =
    Cmd.info "step" ~docs:Options.s_others ~doc:"compute the transitions of configurations, for other programs" ~man
      ~exits:(Options.exits [ Done; Platform_trouble; Bug ])
  in
  Cmd.v info Term.(const run $ const ())
