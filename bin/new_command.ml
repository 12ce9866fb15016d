open Cmdliner
open Dolphin_app
module Safe_print = Dolphin_display.Safe_print

let tell folder =
  Safe_print.printf
    "%s is a mission to start from; see its README.md. Try there:\n\
    \  dolphin exec mission.dol      runs it on the simulated fleet\n\
    \  dolphin explore mission.dol   checks every possible run\n"
    folder

let run folder =
  let made () =
    tell folder;
    Exit_status.Done
  in
  Report.result (Result.map made (Template.write folder))

let folder =
  let doc = "The folder to make. It must not be there yet, or be empty." in
  Arg.(required & pos 0 (some string) None & info [] ~docv:"DIR" ~doc)

let man =
  [ `S Manpage.s_description;
    `P "$(tname) makes a folder with a small mission: two vehicles survey, and one that fails is replaced. The folder \
        has the program ($(i,mission.dol)), a fleet to try it on ($(i,mission.fleet)), $(i,README.md), and \
        $(i,check.sh), which checks and explores the mission, with a workflow that does so on a git server.";
    `S Manpage.s_examples;
    `Pre "  $(mname) $(tname) survey\n  cd survey\n  $(mname) exec mission.dol" ]
  @ Options.see_also

let command =
  let info =
    Cmd.info "new" ~docs:Options.s_setup ~doc:"make a mission to start from" ~man
      ~exits:(Options.exits [ Done; Bad_input; Platform_trouble; Bug ])
  in
  Cmd.v info Term.(const run $ folder)
