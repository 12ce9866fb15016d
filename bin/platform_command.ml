open Cmdliner
open Dolphin_app
module Safe_print = Dolphin_display.Safe_print
module Kit = Dolphin_platform_kit.Kit

let ( let* ) = Result.bind

let tell (v : Kit.verdict) =
  (match v.wrong with
   | None ->
     let remark = Option.fold v.remark ~none:"" ~some:(fun text -> " (" ^ text ^ ")") in
     Safe_print.printf "ok    %-16s %s%s\n" v.name v.what remark
   | Some why ->
     Safe_print.printf "FAIL  %-16s %s\n" v.name v.what;
     Safe_print.printf "      %s\n" why;
     List.iter (fun line -> Safe_print.printf "      | %s\n" line) v.transcript);
  flush stdout

let known only =
  match List.find_opt (fun name -> not (List.mem_assoc name Kit.names)) only with
  | None -> Ok ()
  | Some name ->
    let near = Dolphin_syntax.Diagnostic.suggest name (List.map fst Kit.names) in
    let hint = Option.fold near ~none:"" ~some:(Printf.sprintf " (did you mean '%s'?)") in
    Error (Error.Bad_input (Printf.sprintf "unknown situation '%s'%s" name hint))

let conclude command junit verdicts =
  let failed = List.filter (fun (v : Kit.verdict) -> v.wrong <> None) verdicts in
  Safe_print.printf "%d of %d situations passed\n%!" (List.length verdicts - List.length failed) (List.length verdicts);
  let* () = Option.fold junit ~none:(Ok ()) ~some:(fun path ->
      Text_file.write path (fun channel -> output_string channel (Kit.to_junit ~command verdicts))) in
  Ok (if failed = [] then Exit_status.Done else Failed)

type asked = { adapter : string; plans : Kit.plans; only : string list; junit : string option }

let run { adapter; plans; only; junit } =
  Report.result
    (let* () = known only in
     let interruption = Interruption.make () in
     Interruption.on_signals interruption;
     let goes_on () = not (Interruption.happened interruption) in
     let judged = Interruption.unless interruption (fun () -> Kit.judge plans ~only ~goes_on tell adapter) in
     match Lwt_main.run judged with
     | Some verdicts -> conclude adapter junit verdicts
     | None ->
       Safe_print.line "interrupted; the adapter is ended";
       Ok Exit_status.Interrupted)

(* {1 The command line} *)

let adapter =
  let doc = "The command that starts the adapter; it is given to $(b,/bin/sh)." in
  Arg.(required & pos 0 (some string) None & info [] ~docv:"CMD" ~doc)

let plan name default what =
  Arg.(value & opt string default & info [ name ] ~docv:"PLAN" ~doc:("The name of a plan " ^ what ^ "."))

let short = plan "short" "short" "that vehicles run to its end, within the time of $(b,--patience)"
let long = plan "long" "long" "that lasts longer than all situations together"

let vehicle =
  let doc = "Command only the vehicle $(docv). By default the first one that is ready." in
  Arg.(value & opt (some string) None & info [ "vehicle" ] ~docv:"VEHICLE" ~doc)

let patience =
  let doc = "Wait $(docv) seconds for each answer." in
  Arg.(value & opt (Options.positive ~docv:"SECONDS") 30. & info [ "patience" ] ~docv:"SECONDS" ~doc)

let only =
  let doc = "Only the situation $(docv). May be repeated." in
  Arg.(value & opt_all string [] & info [ "only" ] ~docv:"NAME" ~doc)

let junit =
  let doc = "Write the verdicts into $(docv) as JUnit's XML too." in
  Arg.(value & opt (some string) None & info [ "junit" ] ~docv:"FILE" ~doc)

let asked =
  let open Options.Syntax in
  let+ adapter = adapter
  and+ short = short
  and+ long = long
  and+ vehicle = vehicle
  and+ patience = patience
  and+ only = only
  and+ junit = junit in
  { adapter; plans = { short; long; vehicle; patience }; only; junit }

let man =
  let situation (name, what) = `I ("$(b," ^ name ^ ")", what) in
  [ `S Manpage.s_description;
    `P "$(tname) puts an adapter, a process that speaks the platform protocol ($(i,docs/platform.md)), into \
        situations that it must handle: repeated orders, a slow reader, its own death, the death of the console. Each \
        begins with a new process. After a failure, the last lines of the conversation are shown.";
    `P "The adapter's vehicles move: use simulated ones. They must know two plans by name, a short and a long one.";
    `S "SITUATIONS" ]
  @ List.map situation Kit.names
  @ [ `S Manpage.s_arguments;
      `S Manpage.s_options;
      `S Manpage.s_exit_status;
      `S Manpage.s_examples;
      `Pre "  dolphin platform check examples/adapter.py\n\
           \  dolphin platform check 'dolphin sim kit.fleet --platform --state kit.state' --only killed" ]
  @ Options.see_also

let exits =
  Cmd.Exit.info (Exit_status.code Failed) ~doc:"the adapter fails in some situation."
  :: Options.exits [ Done; Bad_input; Platform_trouble; Interrupted; Bug ]

let check =
  let info = Cmd.info "check" ~doc:"judge an adapter by situations that it must handle" ~man ~exits in
  Cmd.v info Term.(const run $ asked)

let command =
  let man =
    [ `S Manpage.s_description;
      `P "Adapters let programs command vehicles of any kind: $(mname) $(b,exec --platform). $(b,platform check) \
          judges them." ]
    @ Options.see_also
  in
  Cmd.group (Cmd.info "platform" ~docs:Options.s_others ~doc:"judge adapters of vehicles" ~man ~exits) [ check ]
