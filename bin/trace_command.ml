open Cmdliner
open Dolphin_app
open Dolphin_trace
module Safe_print = Dolphin_display.Safe_print

(* {1 Files} *)

let journal position =
  let doc = "The journal of a run, as $(mname) $(b,exec --journal) $(docv) writes it." in
  Arg.(required & pos position (some string) None & info [] ~docv:"RUN" ~doc)

let ( let* ) = Result.bind

(* {1 Check} *)

(* Of a partial trace: the vehicles that are known from the beginning, and its date. *)
let world_of = function
  | None -> Ok (Dolphin_semantics.World.empty, None)
  | Some _ as named ->
    let world (f : Fleet_file.t) = (Dolphin_environment.Scenario_world.still f.scenario, f.scenario.begins) in
    Result.map world (Fleet_file.load named)

let tell_change path (program : Program_file.t) (header : Header.t) =
  if header.program.hash <> (Program_file.header program).hash then
    Report.complain
      (Printf.sprintf "%s is not the program of this run, or has changed since: places are not compared" path)

let status path : Journal_verdict.t -> (Exit_status.t, Error.t) result = function
  | Run _ | Prefix _ | Possible _ -> Ok Done
  | No_run _ | Impossible _ -> Ok Failed
  | Unknown _ -> Ok Inconclusive
  | Unreadable { number; why } -> Error (Journal_file.wrong path ~number why)

(* The tasks that took longer or shorter than in the fleet. *)
let check_times program_path set path fleet tolerance =
  if path = "-" then Error (Error.Bad_input "--timed reads the journal twice, so it must be a file")
  else
    let recorded = Journal_file.settings path in
    let* p, fleet = Program_file.load_with_fleet ~set ?recorded ~fleet program_path in
    let* findings = Time_check.check ?tolerance p fleet path in
    List.iter Safe_print.line findings;
    Ok (if findings = [] then Exit_status.Done else Failed)

let check program_path set path fleet most timed tolerance =
  let timed = timed || tolerance <> None in
  let times (status : Exit_status.t) =
    match status with Done when timed -> check_times program_path set path fleet tolerance | status -> Ok status in
  Report.result
    (let* world, begins = if timed then Ok (Dolphin_semantics.World.empty, None) else world_of fleet in
     let* p, header, verdict =
       Journal_file.with_reader path (fun reader ->
           let* p = Program_file.load_recorded ~set ~recorded:(Journal_file.settings_of reader) program_path in
           let hash = (Program_file.header p).hash in
           let header, verdict = Journal_verdict.check ~world ~most { p.program with begins } ~hash reader in
           Ok (p, header, verdict))
     in
     Option.iter (tell_change program_path p) header;
     let* status = status path verdict in
     Safe_print.format "@[<v 2>%s: %a@]@." path Journal_verdict.pp verdict;
     times status)

let check_exits =
  [ Cmd.Exit.info 0 ~doc:"the journal belongs to a run of the program, or to the beginning of one.";
    Cmd.Exit.info 1 ~doc:"it does not; with $(b,--timed), also if a task or timer took longer or shorter than it may.";
    Cmd.Exit.info 3 ~doc:"a partial trace leaves more possibilities open than $(b,--max-states) allows to visit." ]
  @ Options.exits [ Bad_input; Bug ]

let known =
  let doc =
    "For a partial trace: the vehicles of the file $(docv) are known from the beginning, at their places."
  in
  Arg.(value & opt (some string) None & info [ "fleet" ] ~docv:"FLEET" ~doc)

let most =
  let doc = "For a partial trace: visit at most $(docv) configurations between two lines." in
  Arg.(value & opt int Journal_verdict.most & info [ "max-states" ] ~docv:"N" ~doc)

let timed =
  let doc =
    "Also report the tasks and timers of the run that took longer or shorter than they may, with the fleet \
     $(b,--fleet), by default the file beside $(i,PROG): the bounds are those of $(mname) $(b,time)."
  in
  Arg.(value & flag & info [ "timed" ] ~doc)

let tolerance =
  let doc =
    "With $(b,--timed), which it implies: tolerate $(docv) seconds more or less. By default 1, since links and clocks \
     are not exact, and 0 for simulated runs without $(b,--speed), whose times are exact, unless they were resumed."
  in
  let parse text =
    match float_of_string_opt text with
    | Some seconds when seconds >= 0. && seconds <= 1e9 -> Ok (Float.to_int (Float.round (seconds *. 1000.)))
    | Some _ | None -> Error (`Msg (Printf.sprintf "%s is not a number of seconds, 0 or more" text))
  in
  let print ppf ms = Format.fprintf ppf "%g" (float ms /. 1000.) in
  Arg.(value & opt (some (conv ~docv:"SECONDS" (parse, print))) None & info [ "tolerance" ] ~docv:"SECONDS" ~doc)

let check_command =
  let man =
    [ `S Manpage.s_description;
      `P "$(tname) replays $(i,PROG) along the journal $(i,RUN): each transition must be one that the semantics \
          allows at that point, on the event of the journal, with exactly these changes and effects. A journal that \
          breaks off, even in the middle of a line, is the beginning of a run.";
      `P "If the journal does not belong to a run, $(tname) shows the first line that does not fit, and the possible \
          steps there.";
      `P "A trace whose first line lists its labels, only starts and ends of tasks for example, belongs to a run if \
          some steps lead from each of its lines to the next. See $(i,docs/trace.md). The vehicles are given in the \
          trace or by $(b,--fleet)." ]
    @ Options.see_also
  in
  let info = Cmd.info "check" ~doc:"check that a journal belongs to a run of a program" ~man ~exits:check_exits in
  Cmd.v info Term.(const check $ Options.program $ Options.set $ journal 1 $ known $ most $ timed $ tolerance)

(* {1 Show} *)

(* Samples are many, and not shown. *)
let worth_showing () =
  let silent = Hashtbl.create 16 in
  fun (entry : Entry.t) ->
    match entry with
    | Vehicle { state; _ } ->
      let was_silent = Option.value (Hashtbl.find_opt silent state.id) ~default:false in
      Hashtbl.replace silent state.id (not state.connected);
      was_silent = state.connected
    | Note _ -> false
    | Header _ | Partial _ | Label _ | Event _ | Transition _ | Act _ | Resumed _ | End _ -> true

let show transitions path =
  let read () =
    if transitions then Journal_file.iter (Table.print_transitions Format.std_formatter) path
    else
      let entries = ref [] and is_shown = worth_showing () in
      let keep entry = if is_shown entry then entries := entry :: !entries in
      let result = Journal_file.iter keep path in
      if !entries <> [] then Table.print Format.std_formatter (List.rev !entries);
      result
  in
  let result = read () in
  Format.printf "%!";
  Report.result (Result.map (fun () -> Exit_status.Done) result)

let transitions =
  let doc = "Show every transition, one a line: its number, time, place in the program, rules and label." in
  Arg.(value & flag & info [ "transitions" ] ~doc)

let show_command =
  let man =
    [ `S Manpage.s_description;
      `P "$(tname) prints the journal $(i,RUN) as a page of text: a column for the program and one for each vehicle \
          that it picked, time going down." ]
    @ Options.see_also
  in
  let exits = Options.exits [ Done; Bad_input; Bug ] in
  let info = Cmd.info "show" ~doc:"show a journal as a page of text" ~man ~exits in
  Cmd.v info Term.(const show $ transitions $ journal 0)

(* {1 Draw} *)

let draw path layers drawing =
  let summary = Summary.create () in
  Report.result
    (let* layers = Dolphin_results.Results.map Layer_file.read layers in
     let* () = Journal_file.iter (Summary.add summary) path in
     let* () = Drawing.write (Drawing.over layers drawing) (Summary.finish summary) in
     Ok Exit_status.Done)

let draw_command =
  let drawing =
    let doc = "The file to draw in: $(i,*.svg) or $(i,*.html)." in
    Arg.(required & opt (some Options.drawing) None & info [ "o"; "output" ] ~docv:"FILE" ~doc)
  in
  let man =
    [ `S Manpage.s_description;
      `P "$(tname) draws the journal $(i,RUN): the tasks of each vehicle over time, with the program's steps; the \
          ways of the vehicles, planned and flown, on the maps of $(b,--layer); their batteries. The file is \
          self-contained, prints well, and follows the reader's choice of light or dark." ]
    @ Options.see_also
  in
  let exits = Options.exits [ Done; Bad_input; Bug ] in
  Cmd.v (Cmd.info "draw" ~doc:"draw a journal" ~man ~exits) Term.(const draw $ journal 0 $ Options.layers $ drawing)

(* {1 Export} *)

let export path (options : Export_options.t) =
  let summary = Summary.create ~most_samples:max_int () in
  Report.result
    (let* format = Export_options.format options in
     let* () = Journal_file.iter (Summary.add summary) path in
     let* () = Exported.write format options.path (Exported.of_run (Summary.finish summary)) in
     Ok Exit_status.Done)

let export_command =
  let man =
    [ `S Manpage.s_description;
      `P "$(tname) writes the journal $(i,RUN) for other programs: the track of each vehicle that the program held, \
          and the start of each of its tasks. $(b,csv) has each sample, with battery and task.";
      Export_options.man ]
    @ Options.see_also
  in
  let exits = Options.exits [ Done; Bad_input; Platform_trouble; Bug ] in
  let info = Cmd.info "export" ~doc:"write a journal for maps and spreadsheets" ~man ~exits in
  Cmd.v info Term.(const export $ journal 0 $ Export_options.term)

let command =
  let man =
    [ `S Manpage.s_description;
      `P "A journal records one run of a program, transition by transition. $(mname) $(b,exec --journal) $(i,RUN) \
          writes it, $(i,docs/trace.md) describes it.";
      `S Manpage.s_examples;
      `Pre "  $(mname) exec mission.dol --journal mission.run\n  $(mname) $(tname) check mission.dol mission.run\n\
           \  $(mname) $(tname) show mission.run\n  $(mname) $(tname) draw mission.run -o mission.svg\n\
           \  $(mname) $(tname) export mission.run -o mission.geojson" ]
    @ Options.see_also
  in
  let exits = Options.exits [ Done; Failed; Bad_input; Bug ] in
  let info = Cmd.info "trace" ~docs:Options.s_runs ~doc:"check, show, draw and export journals of runs" ~man ~exits in
  Cmd.group info [ check_command; show_command; draw_command; export_command ]
