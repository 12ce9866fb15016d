open Cmdliner

let man =
  [ `S Manpage.s_description;
    `P "Dolphin is a task orchestration language for networks of autonomous vehicles. One program picks vehicles, \
        gives them tasks, and composes those tasks: in sequence, in parallel, when a condition holds, for a time, \
        until an error.";
    `P "$(mname) $(b,exec) runs a program, $(mname) $(b,explore) checks its every run, $(mname) $(b,check) finds its \
        faults without running it. Each command has a manual: $(mname) $(i,COMMAND) $(b,--help).";
    `S Options.s_setup; `S Options.s_write; `S Options.s_prove; `S Options.s_run; `S Options.s_runs;
    `S Options.s_others;
    `S Manpage.s_examples;
    `Pre "  $(mname) exec examples/rendezvous.dol\n  $(mname) explore examples/rendezvous.dol\n\
         \  $(mname) check mission.dol";
    `S Manpage.s_files;
    `I ("$(i,*.dol)", "Programs. $(i,*.dolphin) works too.");
    `I ("$(i,*.fleet)", "Fleets: vehicles, outcomes of plans, and people's answers.") ]
  @ Options.see_also

let command =
  let info =
    Cmd.info "dolphin" ~version:Version.number ~doc:"orchestrate tasks of autonomous vehicles" ~man
      ~exits:(Options.exits [ Done; Failed; Bad_input; Platform_trouble; Bug; Interrupted ])
  in
  let commands =
    [ Check_command.command; Conform_command.command; Console_command.command; Doctor_command.command;
      Exec_command.command;
      Explore_command.command; Fleet_command.command; Fmt_command.command; Lsp_command.command; Lts_command.command;
      New_command.command; Parse_command.command; Plan_command.command; Platform_command.command;
      Post_command.command; Replace_command.command; Runs_command.command; Sim_command.command; Step_command.command;
      Successors_command.command; Time_command.command;
      Tla_command.command; Trace_command.command; Walk_command.command ] in
  let help = Help_command.command ~others:(List.map Cmd.name commands) in
  Cmd.group info (help :: Console_worker_command.command :: commands)

(* [--sim] alone would take the next argument for its fleet. [dolphin --help PROG] is [dolphin help PROG]. Manuals that
   do not go to a terminal are plain text: overstrikes hide words from grep. *)
let arguments =
  let rec complete = function
    | [] -> []
    | "--" :: _ as rest -> rest
    | "--sim" :: rest -> "--sim=" :: complete rest
    | "--help" :: rest when not (Unix.isatty Unix.stdout) -> "--help=plain" :: complete rest
    | argument :: rest -> argument :: complete rest
  in
  match Array.to_list Sys.argv with
  | [ dolphin; "--help"; program ] when Sys.file_exists program -> [| dolphin; "help"; program |]
  | arguments -> Array.of_list (complete arguments)

let evaluate () =
  match Cmd.eval_value ~err:Report.of_arguments ~catch:false ~argv:arguments command with
  | Ok (`Ok status) -> status
  | Ok (`Help | `Version) -> Exit_status.Done
  | Error (`Parse | `Term) -> Exit_status.Bad_input
  | Error `Exn -> Exit_status.Bug

let bug error =
  Report.complain
    (Printf.sprintf "this is a fault of dolphin itself, not of the program; please report it: %s"
       (Printexc.to_string error));
  Exit_status.Bug

let () =
  (* A write beyond a limit of file sizes fails as any other does. *)
  Sys.set_signal Sys.sigxfsz Signal_ignore;
  let status =
    match
      let status = evaluate () in
      Format.print_flush ();
      flush stdout;
      status
    with
    | status -> status
    | exception Sys_error why ->
      (* If SIGPIPE is ignored, this error means that the reader has gone; ignore it. *)
      if why <> Unix.error_message EPIPE then Report.complain ("the output cannot be written: " ^ why);
      (* The output at exit would be tried once more. *)
      Unix._exit (Exit_status.code Platform_trouble)
    | exception Unix.Unix_error (((EAGAIN | ENOMEM | EMFILE | ENFILE) as code), call, _) ->
      Report.complain (Printf.sprintf "the system lacks resources: %s: %s" call (Unix.error_message code));
      Exit_status.Platform_trouble
    | exception Out_of_memory ->
      Report.complain "there is not enough memory";
      Exit_status.Platform_trouble
    | exception Stack_overflow -> bug Stack_overflow
    | exception error -> bug error
  in
  exit (Exit_status.code status)
