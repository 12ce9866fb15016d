open Cmdliner
open Dolphin_trace

(* {1 Files} *)

let journal position =
  let doc = "The journal of a run, as $(mname) $(b,exec --journal) $(docv) writes it." in
  Arg.(required & pos position (some string) None & info [] ~docv:"RUN" ~doc)

let bad why =
  Report.complain why;
  Exit_status.Bad_input

(* Opens [path] for [f]; [-] is standard input. *)
let with_journal path f =
  let read () =
    if path = "-" then begin
      set_binary_mode_in stdin true;
      f (Journal.of_channel stdin)
    end
    else
      let channel = open_in_bin path in
      Fun.protect ~finally:(fun () -> close_in_noerr channel) (fun () -> f (Journal.of_channel channel))
  in
  match read () with
  | status -> status
  | exception Sys_error why -> bad (if String.length why > 0 && why.[0] = path.[0] then why else path ^ ": " ^ why)

(* [fold path f] gives each line to [f], and is [Done] if all of them are lines of a journal. *)
let each_line path f =
  with_journal path (fun reader ->
      let rec go () =
        match Journal.next reader with
        | Line { entry; _ } -> f entry; go ()
        | Torn _ | End_of_file -> Exit_status.Done
        | Wrong { number; why } -> bad (Printf.sprintf "%s:%d: %s" path number why)
      in
      go ())

(* {1 Check} *)

(* Of a partial trace: the vehicles that are known from the beginning. *)
let world_of = function
  | None -> Ok Dolphin_semantics.World.empty
  | Some _ as named ->
    let world (f : Fleet_file.t) = Dolphin_environment.Scenario_world.still f.scenario in
    Result.map world (Fleet_file.load named)

let check program_path path fleet most =
  match Program_file.load program_path, world_of fleet with
  | Error trouble, _ ->
    Program_file.tell trouble;
    Exit_status.Bad_input
  | Ok _, Error trouble ->
    Fleet_file.tell trouble;
    Exit_status.Bad_input
  | Ok p, Ok world ->
    with_journal path (fun reader ->
        let hash = (Header.source ~path:program_path p.source).hash in
        let header, verdict = Verdict.check ~world ~most p.program ~hash reader in
        let is_other (h : Header.t) = h.program.hash <> hash in
        if Option.fold ~none:false ~some:is_other header then
          Report.complain
            (Printf.sprintf "%s is not the text that this run was of, or has changed since: places are not compared"
               program_path);
        match verdict with
        | Run _ | Prefix _ | Possible _ -> Format.printf "@[<v 2>%s: %a@]@." path Verdict.pp verdict; Exit_status.Done
        | No_run _ | Impossible _ -> Format.printf "@[<v 2>%s: %a@]@." path Verdict.pp verdict; Exit_status.Failed
        | Unknown _ -> Format.printf "@[<v 2>%s: %a@]@." path Verdict.pp verdict; Exit_status.Inconclusive
        | Unreadable { number; why } -> bad (Printf.sprintf "%s:%d: %s" path number why))

let check_exits =
  [ Cmd.Exit.info 0 ~doc:"the journal is one of a run of the program, or of the beginning of one.";
    Cmd.Exit.info 1 ~doc:"it is not.";
    Cmd.Exit.info 3 ~doc:"a partial trace leaves more possibilities open than $(b,--max-states) allows to go through." ]
  @ Options.exits [ Bad_input; Bug ]

let known =
  let doc = "Of a partial trace: know the vehicles of the file $(docv) from the beginning, where it places them." in
  Arg.(value & opt (some string) None & info [ "fleet" ] ~docv:"FLEET" ~doc)

let most =
  let doc = "Of a partial trace: look at $(docv) configurations at most between two lines." in
  Arg.(value & opt int Verdict.most & info [ "max-states" ] ~docv:"N" ~doc)

let check_command =
  let man =
    [ `S Manpage.s_description;
      `P "$(tname) runs $(i,PROG) again in thought, as the journal $(i,RUN) says: each transition must be one that the \
          semantics has at that point, on the event that the journal tells of, with just these changes and effects. A \
          journal that breaks off, even in the middle of a line, is one of the beginning of a run.";
      `P "Of a journal that is none of a run, the first line that does not fit is told, and what could have happened \
          there instead.";
      `P "A trace whose first line says which labels it has, only starts and ends of tasks for example, is one of a \
          run if there are steps between its lines that lead from each to the next. $(i,docs/trace.md) describes it. \
          It may say itself which vehicles there are, or $(b,--fleet) does." ]
    @ Options.see_also
  in
  let info = Cmd.info "check" ~doc:"tell whether a journal is one of a run of a program" ~man ~exits:check_exits in
  Cmd.v info Term.(const check $ Options.program $ journal 1 $ known $ most)

(* {1 Show} *)

let show transitions path =
  if transitions then each_line path (Table.print_transitions Format.std_formatter)
  else
    let entries = ref [] in
    (* Samples are many, and not shown. *)
    let silent = Hashtbl.create 16 in
    let keep (entry : Entry.t) =
      match entry with
      | Vehicle { state; _ } ->
        let was_silent = Option.value (Hashtbl.find_opt silent state.id) ~default:false in
        if was_silent = state.connected then begin
          Hashtbl.replace silent state.id (not state.connected);
          entries := entry :: !entries
        end
      | Note _ -> ()
      | Header _ | Partial _ | Label _ | Event _ | Transition _ | Resumed _ | End _ -> entries := entry :: !entries
    in
    let status = each_line path keep in
    if !entries <> [] then Table.print Format.std_formatter (List.rev !entries);
    Format.printf "%!";
    status

let show_command =
  let transitions =
    let doc = "Show every transition, one a line: its number, time, place in the program, rules and label." in
    Arg.(value & flag & info [ "transitions" ] ~doc)
  in
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

let draw path drawing =
  let builder = Summary.create () in
  match each_line path (Summary.add builder) with
  | Done -> (
      match Drawing_file.write drawing (Summary.finish builder) with
      | Ok () -> Exit_status.Done
      | Error why -> bad why)
  | (Failed | Violated | Bad_input | Platform_trouble | Inconclusive | Bug | Interrupted) as status -> status

let draw_command =
  let drawing =
    let doc = "The file to draw in: $(i,*.svg) or $(i,*.html)." in
    Arg.(required & opt (some Drawing_file.argument) None & info [ "o"; "output" ] ~docv:"FILE" ~doc)
  in
  let man =
    [ `S Manpage.s_description;
      `P "$(tname) draws the journal $(i,RUN): the tasks of each vehicle over time, with what the program did; the \
          ways of the vehicles; their batteries. The file needs nothing but itself, prints well, and follows the \
          reader's choice of light or dark." ]
    @ Options.see_also
  in
  let exits = Options.exits [ Done; Bad_input; Bug ] in
  Cmd.v (Cmd.info "draw" ~doc:"draw a journal" ~man ~exits) Term.(const draw $ journal 0 $ drawing)

let command =
  let man =
    [ `S Manpage.s_description;
      `P "A journal tells of one run of a program, transition by transition. $(mname) $(b,exec --journal) $(i,RUN) \
          writes it, $(i,docs/trace.md) describes it.";
      `S Manpage.s_examples;
      `Pre "  $(mname) exec mission.dol --journal mission.run\n  $(mname) $(tname) check mission.dol mission.run\n\
           \  $(mname) $(tname) show mission.run\n  $(mname) $(tname) draw mission.run -o mission.svg" ]
    @ Options.see_also
  in
  let exits = Options.exits [ Done; Failed; Bad_input; Bug ] in
  let info = Cmd.info "trace" ~doc:"check, show and draw journals of runs" ~man ~exits in
  Cmd.group info [ check_command; show_command; draw_command ]
