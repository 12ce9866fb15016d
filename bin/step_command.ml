open Cmdliner

let run () =
  set_binary_mode_in stdin true;
  Dolphin_app.Oracle_server.serve ~name:("dolphin " ^ Version.number) stdin stdout;
  Exit_status.Done

let man =
  [ `S Manpage.s_description;
    `P "$(tname) answers questions about the semantics on its standard input, in lines of JSON: a program and a fleet \
        in, where its runs begin out; a configuration in, all its transitions out, each with its rules, label, effects \
        and next configuration. A configuration can be kept, compared, and asked about at any time: nothing is \
        remembered but the program that was given last.";
    `P "So another implementation can be held against this one, and tools can walk through a program's runs without \
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
    Cmd.info "step" ~docs:Options.s_others ~doc:"tell what a configuration can do, for other programs" ~man
      ~exits:(Options.exits [ Done; Platform_trouble; Bug ])
  in
  Cmd.v info Term.(const run $ const ())
