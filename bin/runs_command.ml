open Cmdliner
open Dolphin_app
open Dolphin_trace
module Safe_print = Dolphin_display.Safe_print

(* {1 List} *)

let how : Run_folder.state -> string = function
  | Ended { how; _ } -> how
  | Going_on -> "goes on"
  | Broken_off -> "broke off"

let row ({ name; header; time; state; _ } : Run_folder.run) =
  [ name; header.program.path; header.platform; how state; Phrase.time time ]

let heads = [ "RUN"; "PROGRAM"; "PLATFORM"; "STATE"; "TIME" ]

let tell = function
  | [] -> Safe_print.line "no run has been kept: dolphin exec --keep keeps one"
  | runs -> List.iter Safe_print.line (Dolphin_display.Text_table.lines heads (List.map row runs))

let list () =
  Report.result
    (Result.map
       (fun runs ->
          tell runs;
          Exit_status.Done)
       (Run_folder.list ()))

(* {1 Show} *)

let show transitions name =
  Report.result
    (Result.map
       (fun path ->
          Safe_print.format "%s@.@." path;
          Trace_command.show transitions path)
       (Run_folder.find name))

let show_command =
  let run =
    let doc = "The run: its name or a prefix of it; by default the $(b,latest)." in
    Arg.(value & pos 0 string "latest" & info [] ~docv:"RUN" ~doc)
  in
  let man =
    [ `S Manpage.s_description;
      `P "$(tname) prints where the journal of the run $(i,RUN) is, and shows it as $(mname) $(b,trace show) does." ]
    @ Options.see_also
  in
  let exits = Options.exits [ Done; Bad_input; Platform_trouble; Bug ] in
  Cmd.v (Cmd.info "show" ~doc:"show a run" ~man ~exits) Term.(const show $ Trace_command.transitions $ run)

(* {1 All} *)

let list_term = Term.(const list $ const ())

let list_command =
  let exits = Options.exits [ Done; Platform_trouble; Bug ] in
  Cmd.v (Cmd.info "list" ~doc:"list the runs, as without a command" ~man:Options.see_also ~exits) list_term

let command =
  let man =
    [ `S Manpage.s_description;
      `P "$(tname) lists the runs whose journals are kept for the user, the latest first: those on vehicles of a \
          network, and those of $(mname) $(b,exec --keep). A run that broke off is resumed by $(mname) $(b,exec \
          --resume) with the path that $(tname) $(b,show) prints. To forget a run, remove its file.";
      `S "FILES";
      `I ("$(b,XDG_STATE_HOME)/dolphin/runs", "The journals. By default $(b,XDG_STATE_HOME) is ~/.local/state.");
      `S Manpage.s_examples;
      `Pre "  $(mname) exec mission.dol --keep\n  $(mname) $(tname)\n  $(mname) $(tname) show" ]
    @ Options.see_also
  in
  let exits = Options.exits [ Done; Platform_trouble; Bug ] in
  let info = Cmd.info "runs" ~docs:Options.s_runs ~doc:"list and show the runs that were kept" ~man ~exits in
  Cmd.group ~default:list_term info [ list_command; show_command ]
