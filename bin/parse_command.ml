open Cmdliner
open Dolphin_app

let run path =
  match Program_file.parse path with
  | Error e -> Report.error e
  | Ok program ->
    Format.printf "%a@?" Dolphin_syntax.Print.program program;
    Exit_status.Done

let man =
  [ `S Manpage.s_description;
    `P "$(tname) reads the program and writes it on standard output as $(mname) has understood it: one statement a \
        line, four spaces a level, only the necessary parentheses, every operator in its one spelling. The output \
        means the same as the input. Comments are left out.";
    `P "It answers doubts about precedence: which operator binds closer, where a command without parentheses ends.";
    `S Manpage.s_examples;
    `Pre "  $(mname) $(tname) examples/rendezvous.dol" ]
  @ Options.see_also

let command =
  let info =
    Cmd.info "parse" ~docs:Options.s_write ~doc:"print a program as it was understood" ~man
      ~exits:(Options.exits [ Done; Bad_input; Bug ])
  in
  Cmd.v info Term.(const run $ Options.program)
