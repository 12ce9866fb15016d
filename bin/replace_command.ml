open Cmdliner
open Dolphin_app
module Safe_print = Dolphin_display.Safe_print

let ( let* ) = Result.bind
let trouble result = Result.map_error (fun why -> Error.Bad_input why) result

(* The continuations of the run, with the new program; [None] if nothing can go wrong in them. *)
let explored present program fleet ~faults ~timeout =
  let settings = { Exploration.plain with faults; timeout = Some timeout } in
  let explore ~interrupted ~progress =
    Exploration.explore ~from:present ~interrupted ~progress settings program fleet in
  let* outcome = Watched.search ~json:false explore in
  match Exploration.verdict ~strict:false outcome with
  | Holds -> Ok None
  | (Violated | Inconclusive) as verdict ->
    Exploration_report.print ~from:present ~strict:false program outcome;
    Report.complain "the run goes on with the program that it has; --force replaces it all the same";
    Ok (Some (Exit_status.of_verdict verdict))

let absolute path = if Filename.is_relative path then Filename.concat (Sys.getcwd ()) path else path

let replace (program : Program_file.t) journal =
  let* connection = trouble (Run_socket.connect ~journal) in
  let { Dolphin_trace.Header.hash; _ } = Program_file.header program in
  let* time = trouble (Run_socket.replace connection ~set:program.set ~hash (absolute program.path)) in
  Safe_print.printf "replaced at %s: the run goes on with %s\n" (Dolphin_trace.Phrase.time time) program.path;
  Ok Exit_status.Done

let run () name path set ~faults ~timeout ~force =
  Report.result
    (let* journal = Run_folder.journal name in
     let* present, program, fleet = Present.load path ~set ~fleet:None ~journal in
     Report.diagnostics ~source:program.source program.warnings;
     let* refused = if force then Ok None else explored present program fleet ~faults ~timeout in
     match refused with Some status -> Ok status | None -> replace program journal)

let run_name =
  let doc = "The run: its name or a prefix of it, $(b,latest), or the path of its journal." in
  Arg.(required & pos 0 (some string) None & info [] ~docv:"RUN" ~doc)

let program =
  let doc = "The program with which the run goes on." in
  Arg.(required & pos 1 (some string) None & info [] ~docv:"PROG" ~doc)

let timeout =
  let doc = "Explore for at most $(docv) seconds. A search that takes longer is inconclusive." in
  Arg.(value & opt (Options.positive ~docv:"SECONDS") 60. & info [ "timeout" ] ~docv:"SECONDS" ~doc)

let force =
  let doc = "Do not explore. The run so far has to be the beginning of a run of $(i,PROG) all the same." in
  Arg.(value & flag & info [ "force" ] ~doc)

let command =
  let man =
    [ `S Manpage.s_description;
      `P "$(tname) makes a run in progress go on with the program $(i,PROG), a changed version of its own. The run so \
          far has to be the beginning of a run of $(i,PROG), too: else the first line of the journal that differs is \
          printed, and nothing is changed. Then $(tname) explores all continuations of the run with $(i,PROG), as \
          $(mname) $(b,explore --from) $(i,RUN) does, and replaces the program only if every property holds.";
      `P "The change itself commands no vehicle: tasks, timers, questions and calls go on. It takes place when the run \
          next waits for an event, and is a line of the journal, after which the run is resumed with $(i,PROG) if its \
          console dies. Parameters have the values that they have in the run, unless $(b,--set) is given. Fences \
          cannot be changed.";
      `P "Runs on vehicles of a network can be changed in this way, and simulated ones with $(b,--speed) and a \
          journal: those that have a socket. See $(i,docs/socket.md).";
      `S Manpage.s_examples;
      `Pre "  $(mname) exec mission.dol --speed 1 --keep\n  $(mname) $(tname) latest changed.dol" ]
    @ Options.see_also
  in
  let info =
    Cmd.info "replace" ~docs:Options.s_run ~doc:"change the program of a run in progress" ~man
      ~exits:(Options.exits [ Done; Violated; Inconclusive; Bad_input; Platform_trouble; Interrupted; Bug ])
  in
  let run setup name path set faults timeout force = run setup name path set ~faults ~timeout ~force in
  Cmd.v info
    Term.(const run $ Verbosity.setup $ run_name $ program $ Options.set $ Explore_command.faults $ timeout $ force)
