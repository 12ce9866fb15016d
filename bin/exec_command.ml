open Cmdliner
open Dolphin_app

(* On a network, a fleet that is given contributes only its answers, replies, fences and the place of plans; there
   are no default ones. *)
let fleet_of ~path ~sim ~named ~is_simulated =
  if is_simulated then Fleet_file.load_for ~program:path named
  else if sim <> None || named = None then Ok Fleet_file.nobody
  else Fleet_file.load named

(* The options that do not go together, if any. *)
let contradiction (s : Run.settings) ~sim ~follow ~resumed ~changed =
  let { Recording.journal; drawing = _; follower = _ } = s.recording in
  let on_network = not (Run.is_simulated s) in
  if on_network && (sim <> None || s.speed <> None) then
    Some
      "vehicles of a network (--imc, --platform) are not simulated: --sim and --speed do not go with them"
  else if
    follow <> None
    && (on_network || s.speed <> None || s.answers <> [] || s.supplier <> None || journal <> None
        || resumed <> None)
  then Some "a recorded run (--follow) takes a program, a fleet, --draw and --layer, and no other options"
  else if changed && resumed = None then Some "--force-prefix goes with --resume"
  else if journal = Some "-" then
    Some "standard output has the log, so the journal needs a file: name one (./- for a file called -)"
  else None

let last_words = "interrupted twice: ended at once; vehicles not yet ordered to stop keep running"

let on_terminal show (s : Run.settings) program run : Exit_status.t =
  let again () =
    (try if not (Run.is_simulated s) then Report.complain last_words with Sys_error _ -> ());
    Exit_status.exit_interrupted ()
  in
  match Terminal_run.run ~notice:Report.complain ~again show program run with
  | Error e -> Report.error e
  | Ok (outcome, program) -> (
      Option.iter Report.tell (Run.explain program outcome);
      match outcome with
      | Ended Completed -> Done
      | Ended Interrupted -> Interrupted
      | Ended (Halted _ | Failed _) | Stuck _ | Spins _ -> Failed)

let follow (program : Program_file.t) (fleet : Fleet_file.t) ~drawing path =
  let status : Dolphin_semantics.Configuration.ending option -> Exit_status.t = function
    | Some (Failed fault) ->
      Report.diagnostics ~source:program.source [ Program_file.diagnostic program fault ];
      Failed
    | Some (Halted _) -> Failed
    | Some Interrupted -> Interrupted
    | Some Completed | None -> Done
  in
  Result.map status (Witness_run.print program fleet ~drawing path)

let ( let* ) = Result.bind

(* A vehicle that the fleet does not have is a slip; on a network it may exist. *)
let check_only (s : Run.settings) (fleet : Fleet_file.t) only =
  let known = List.map (fun (v : Dolphin_scenario.Scenario.vehicle) -> v.id) fleet.scenario.vehicles in
  match Run.is_simulated s, List.find_opt (fun v -> not (List.mem v known)) only with
  | false, _ | true, None -> Ok ()
  | true, Some v ->
    let near = Dolphin_syntax.Diagnostic.suggest v known in
    let hint = Option.fold near ~none:"" ~some:(Printf.sprintf " (did you mean '%s'?)") in
    Error (Error.Bad_input (Printf.sprintf "--only: the fleet has no vehicle '%s'%s" v hint))

(* The place of the journal. Vehicles that move have one: their run can then be resumed. *)
let journal_of ~path ~is_simulated ~keep ~follow ~resumed journal =
  if journal <> None || resumed <> None || follow <> None then
    if keep then Error (Error.Bad_input "--keep excludes --journal, --resume and --follow") else Ok journal
  else if keep then Result.map Option.some (Run_folder.fresh ~program:path)
  else if is_simulated then Ok None
  else
    match Run_folder.fresh ~program:path with
    | Ok journal -> Ok (Some journal)
    | Error e ->
      Report.complain (Format.asprintf "this run has no journal, and cannot be resumed: %a" Error.pp e);
      Ok None

(* The parameters of the run that is resumed. *)
let settings_before ~follow ~resumed =
  match follow, resumed with
  | Some path, _ -> Witness_file.settings path
  | None, Some path -> Journal_file.settings path
  | None, None -> None

(* Runs without a display: options that show, keep or steer a single one do not go with them. *)
let check_sampling (s : Run.settings) show ~follow ~resumed ~keep =
  if not (Run.is_simulated s) || s.speed <> None then
    Error (Error.Bad_input "--runs and --until are for simulated runs, as fast as they go: without --imc, --platform \
                            and --speed")
  else if
    follow <> None || resumed <> None || keep || s.supplier <> None || s.supplier_timeout <> None
    || Recording.is_wanted { s.recording with drawing = None }
    || show.Terminal_run.quiet || show.only <> [] || show.colour <> None
  then
    Error (Error.Bad_input "many runs (--runs, --until) have one answer: of the other options only --fleet, --sim, \
                            --set, --begins, --zone, --seed, --answer and --draw are allowed")
  else Ok ()

let sample (s : Run.settings) program fleet (sampling : Sampling_options.t) =
  let drawing = s.recording.drawing in
  let* () = Option.fold drawing ~none:(Ok ()) ~some:Drawing.check in
  Sampling_options.run sampling ~drawing ~seed:s.seed ~answers:s.answers program fleet

(* Layers lie below the ways of one run. *)
let drawing_over ~sampling layers drawing =
  match layers, drawing with
  | [], _ -> Ok drawing
  | _ :: _, None -> Error (Error.Bad_input "--layer needs --draw: it is a map below the ways of the run")
  | _ :: _, Some _ when sampling <> None ->
    Error (Error.Bad_input "--layer excludes --runs and --until: these draw the ends of runs, and no ways")
  | layers, Some drawing ->
    let* layers = Dolphin_results.Results.map Layer_file.read layers in
    Ok (Some (Drawing.over layers drawing))

(* [again]: the run has begun before. *)
let dated (fleet : Fleet_file.t) ~begins ~zone ~is_simulated ~again =
  let { Dolphin_scenario.Scenario.begins = of_fleet; zone = zone_of_fleet; _ } = fleet.scenario in
  let zone' = if zone = None then zone_of_fleet else zone in
  let in_zone (t : Dolphin_semantics.Calendar.t) = { t with zone = Option.value zone' ~default:t.zone } in
  match begins, zone with
  | Some _, _ | _, Some _ when again ->
    Error (Error.Bad_input "a run goes on at the date at which it began: leave out --begins and --zone")
  | Some _, _ when not is_simulated ->
    Error (Error.Bad_input "vehicles of a network (--imc, --platform) have the time of the clock: leave out --begins")
  | Some text, _ ->
    let read = Dolphin_semantics.Calendar.read ~zone:(Option.value zone' ~default:0) text in
    let read = Result.map_error (fun why -> Error.Bad_input ("--begins: " ^ why)) read in
    Result.map (fun begins -> Fleet_file.beginning (Some begins) fleet) read
  | None, _ ->
    let fleet = Fleet_file.beginning (Option.map in_zone of_fleet) fleet in
    Ok { fleet with scenario = { fleet.scenario with zone = zone' } }

(* From this number of vehicles on, the lists of a run outgrow a small nursery before they are garbage. *)
let large_fleet = 200

(* What is run, and how it is shown; [named] is the fleet. *)
type asked = {
  show : Terminal_run.show;
  path : string;
  set : (string * string) list;
  begins : string option;
  zone : int option;
  sim : string option;
  named : string option;
  definition : string option;
  keep : bool;
  layers : string list;
  recorded : string option;
  resumed : string option;
  changed : bool;
  sampling : Sampling_options.t option;
}

let run () asked settings =
  let { show; path; set; begins; zone; sim; named; definition; keep; layers; recorded; resumed; changed; sampling } =
    asked in
  let { Recording.journal; drawing; _ } = settings.Run.recording in
  let is_simulated = Run.is_simulated settings in
  Report.result
    (let* drawing = drawing_over ~sampling layers drawing in
     let settings = { settings with recording = { settings.recording with drawing } } in
     let* program = Program_file.load_recorded ~set ~recorded:(settings_before ~follow:recorded ~resumed) path in
     let* fleet = if resumed = None then fleet_of ~path ~sim ~named ~is_simulated else Ok Fleet_file.nobody in
     let* fleet = dated fleet ~begins ~zone ~is_simulated ~again:(resumed <> None || recorded <> None) in
     let* program = if resumed = None then Program_file.within fleet program else Ok program in
     let* () =
       match contradiction settings ~sim ~follow:recorded ~resumed ~changed with
       | Some why -> Error (Error.Bad_input why)
       | None -> Ok ()
     in
     let* () =
       if sampling = None then Ok () else check_sampling settings show ~follow:recorded ~resumed ~keep in
     let* journal = journal_of ~path ~is_simulated ~keep ~follow:recorded ~resumed journal in
     let settings = { settings with recording = { settings.recording with journal } } in
     let* definition = Definition_file.load definition in
     let network = Option.map (Imc_options.with_names definition) settings.network in
     let settings = { settings with network } in
     let* () = if resumed = None then check_only settings fleet show.Terminal_run.only else Ok () in
     let on_terminal = on_terminal { show with journal = (if journal = None then resumed else journal) } in
     Report.diagnostics ~source:program.source program.warnings;
     if is_simulated && sampling = None && List.compare_length_with fleet.scenario.vehicles large_fleet > 0 then
       Minor_heap.enlarge ();
     match recorded, resumed, sampling with
     | _, _, Some sampling -> sample settings program fleet sampling
     | Some recorded, _, None -> follow program fleet ~drawing recorded
     | None, Some run, None ->
       let run front ~interruption = Run.resume front ~interruption settings ~changed ~fleet:named program run in
       Ok (on_terminal settings program run)
     | None, None, None ->
       let run front ~interruption = Run.start front ~interruption settings program fleet in
       Ok (on_terminal settings program run))

let positive = Options.positive ~docv:"NUMBER"

let sim =
  let doc =
    "Run on the simulated fleet that the file $(docv) describes. Without $(docv), as by default: the file beside \
     $(i,PROG) with the ending $(b,.fleet), or else the built-in fleet."
  in
  Arg.(value & opt ~vopt:(Some "") (some string) None & info [ "sim" ] ~docv:"FLEET" ~doc)

let fleet =
  let doc = "The same as $(b,--sim=)$(docv)." in
  Arg.(value & opt (some string) None & info [ "fleet" ] ~docv:"FLEET" ~doc)

let speed =
  let doc = "Let time pass $(docv) times as fast as in reality. By default the run does not wait." in
  Arg.(value & opt (some positive) None & info [ "speed" ] ~docv:"X" ~doc)

let begins =
  let doc =
    "The date at which a simulated run begins, for $(b,timeOfDay()): $(b,--begins '2026-06-01 21:00'). By default that \
     of the fleet. Runs on vehicles of a network begin when the clock says."
  in
  Arg.(value & opt (some string) None & info [ "begins" ] ~docv:"DATE" ~doc)

let zone =
  let doc =
    "The time zone of $(b,timeOfDay()): $(b,UTC), or an offset from it such as $(b,+01:00), for the whole run. By \
     default the zone of the fleet; else UTC in a simulated run, and on vehicles of a network the local zone as it is \
     at the start."
  in
  let read text = Result.map_error (fun why -> `Msg why) (Dolphin_semantics.Calendar.zone text) in
  let zone = Arg.conv ~docv:"ZONE" (read, Dolphin_semantics.Calendar.pp_zone) in
  Arg.(value & opt (some zone) None & info [ "zone" ] ~docv:"ZONE" ~doc)

let seed =
  let doc = "The seed of random numbers, by default 0: two runs with the same seed have the same log." in
  Arg.(value & opt (some int) None & info [ "seed" ] ~docv:"N" ~doc)

let answers =
  let doc =
    "Answer a question of the program ($(b,ask)) with $(docv), an expression. May be repeated: the first one answers \
     the first question. Further questions are answered by the fleet, or else on standard input. An answer that \
     begins with a minus sign is written $(b,--answer=-1)."
  in
  Arg.(value & opt_all string [] & info [ "answer" ] ~docv:"TEXT" ~doc)

let supplier =
  let doc =
    "The command that starts the supplier, the process behind $(b,getSupplier()). It is given to $(b,/bin/sh). \
     Without it, calls get the replies of the fleet."
  in
  Arg.(value & opt (some string) None & info [ "supplier" ] ~docv:"CMD" ~doc)

let supplier_timeout =
  let doc = "Give the supplier $(docv) seconds for each reply. By default without a limit." in
  Arg.(value & opt (some positive) None & info [ "supplier-timeout" ] ~docv:"SECONDS" ~doc)

let journal =
  let doc =
    "Keep a journal of the run in the file $(docv): every transition, its cause, the positions of the vehicles. \
     $(mname) $(b,trace) checks, shows and draws journals."
  in
  Arg.(value & opt (some string) None & info [ "o"; "journal" ] ~docv:"FILE" ~doc)

let keep =
  let doc =
    "Keep a journal of the run among those that $(mname) $(b,runs) lists. Runs on vehicles of a network are always \
     kept there, unless $(b,--journal) names a file."
  in
  Arg.(value & flag & info [ "keep" ] ~doc)

let drawing =
  let doc =
    "Draw the run in the file $(docv), $(i,*.svg) or $(i,*.html), when it is over: a timeline of the vehicles' tasks, \
     their ways, their batteries. With $(b,--runs): the number of ended runs over time."
  in
  Arg.(value & opt (some Options.drawing) None & info [ "draw" ] ~docv:"FILE" ~doc)

let follow =
  let doc =
    "Take only the steps of the run in the file $(docv), written by $(mname) $(b,explore --trace). The log, and the \
     picture of $(b,--draw), have step numbers in place of times."
  in
  Arg.(value & opt (some string) None & info [ "follow" ] ~docv:"FILE" ~doc)

let resumed =
  let doc =
    "Resume the run whose journal is the file $(docv), and whose console died. Nothing done is done again: vehicles \
     report the plans that they run; running plans are waited for, plans that ended meanwhile count as ended, and \
     plans that were never started are started. The journal continues in the same file, or with $(b,--journal) in \
     another one. See $(i,docs/trace.md)."
  in
  Arg.(value & opt (some string) None & info [ "resume" ] ~docv:"RUN" ~doc)

let no_socket =
  let doc =
    "Have no socket beside the journal: the run cannot be followed, stopped or posted to from outside. Only runs in \
     real time, on vehicles of a network or with $(b,--speed), have one."
  in
  Arg.(value & flag & info [ "no-socket" ] ~doc)

let changed =
  let doc =
    "With $(b,--resume): resume although the program has changed since, if the run so far is also the beginning of a \
     run of the changed program."
  in
  Arg.(value & flag & info [ "force-prefix" ] ~doc)

let show =
  let quiet =
    let doc =
      "Print only failures, messages and questions of the program, and at the end a summary of the run."
    in
    Arg.(value & flag & info [ "q"; "quiet" ] ~doc)
  in
  let only =
    let doc = "Print only lines about the vehicle $(docv), and failures. May be repeated." in
    Arg.(value & opt_all string [] & info [ "only" ] ~docv:"VEHICLE" ~doc)
  in
  let colour =
    let whens = [ ("auto", None); ("always", Some true); ("never", Some false) ] in
    let doc =
      "Whether trouble is red: $(b,always), $(b,never), or $(b,auto) (the default): on terminals, without NO_COLOR."
    in
    Arg.(value & opt (enum whens) None & info [ "color" ] ~docv:"WHEN" ~doc)
  in
  let make quiet only colour = { Terminal_run.quiet; only; colour; journal = None } in
  Term.(const make $ quiet $ only $ colour)

let man =
  [ `S Manpage.s_description;
    `P "$(tname) checks the program $(i,PROG) as $(mname) $(b,check) does and runs it on a fleet of simulated \
        vehicles. The vehicles move, their batteries drain, their plans take the time given in the fleet file and may \
        fail. Unless $(b,--speed) is given the run takes no longer than its computation: a mission of an hour is over \
        at once.";
    `P "The log on standard output has a line for each event: the time since the start, the vehicle or the program, \
        the event. On a terminal, a board below it shows the events that the program waits for, and each vehicle: its \
        task, the time since the start of the task, its battery and position; vehicles in trouble come first. The \
        last lines are the end of the run, the outcome of its tasks, and the path of its journal.";
    `P "Ctrl-C interrupts the program: running tasks are stopped, vehicles are released. A second Ctrl-C ends \
        $(mname) at once. If the program has a task for this case ($(b,onInterrupt)), such as a way home, the second \
        Ctrl-C stops that task, and a third one ends $(mname).";
    `P "With $(b,-vv) every event, transition and effect of the run, and on a network every datagram, is logged on \
        standard error: $(mname) $(tname) mission.dol -vv 2> debug.log.";
    `S Manpage.s_arguments;
    `S Manpage.s_options;
    `S Imc_options.s_network;
    `P "With $(b,--imc) the program runs on real vehicles, or on any system that speaks IMC as they do; see \
        $(i,docs/imc.md). Of a fleet that $(b,--fleet) names, only the answers, the replies, the fences and the place \
        of plans are used then.";
    `S Platform_options.s_platforms;
    `P "With $(b,--platform) the program runs on vehicles of any kind, through adapters; with several of these \
        options, and $(b,--imc), on all of them at once. $(mname) $(b,sim --platform) is an adapter of the simulated \
        fleet.";
    `S Sampling_options.s_many;
    `P "With $(b,--runs) there is no log: $(mname) $(tname) makes many simulated runs, with consecutive seeds from \
        $(b,--seed) on, in as many processes as the machine has processors. It prints the number of runs for each \
        ending, the end times of completed runs, and how often each task began, ended, failed and was stopped and \
        each error handler ran. Shares have an interval (Clopper and Pearson) and its confidence. $(mname) $(tname) \
        --seed shows a single run. $(mname) $(b,time) computes the bounds of all runs.";
    `P "Ctrl-C ends it with the results so far. The endings of the runs do not affect the exit status.";
    `S Manpage.s_exit_status;
    `S Manpage.s_files;
    `I ("$(i,PROG) with the ending $(b,.fleet)", "The fleet, unless $(b,--sim) or $(b,--fleet) names another.");
    `S Manpage.s_examples;
    `P "The mission of the paper, as fast as possible; then at sixty times the speed of reality, which shows the \
        board:";
    `Pre "  $(mname) $(tname) examples/rendezvous.dol\n  $(mname) $(tname) examples/rendezvous.dol --speed 60";
    `P "On another fleet, with another seed, and with an answer to the program's question:";
    `Pre "  $(mname) $(tname) mission.dol --fleet harbour.fleet --seed 7 --answer 2";
    `P "With tasks from a script, which has ten seconds for each reply:";
    `Pre "  $(mname) $(tname) examples/supplier.dol \\\\\n    --supplier examples/supplier.py --supplier-timeout 10";
    `P "With a journal of the run, and a picture of it:";
    `Pre "  $(mname) $(tname) mission.dol --journal mission.run --draw mission.svg --layer coast.geojson";
    `P "How long ten thousand runs take; then as many runs as needed to know the share that completes:";
    `Pre "  $(mname) $(tname) examples/rendezvous.dol --runs 10000\n  $(mname) $(tname) mission.dol --until 0.01";
    `P "Resuming it after the console was killed:";
    `Pre "  $(mname) $(tname) mission.dol --resume mission.run" ]
  @ Options.see_also

let asked =
  let open Options.Syntax in
  let+ show = show
  and+ path = Options.program
  and+ set = Options.set
  and+ begins = begins
  and+ zone = zone
  and+ sim = sim
  and+ fleet = fleet
  and+ definition = Imc_options.definition
  and+ keep = keep
  and+ layers = Options.layers
  and+ recorded = follow
  and+ resumed = resumed
  and+ changed = changed
  and+ sampling = Sampling_options.wanted in
  (* [--sim=FLEET] is a longer name for [--fleet FLEET]. *)
  let named = match fleet, sim with Some _, _ -> fleet | None, (None | Some "") -> None | None, Some _ -> sim in
  { show; path; set; begins; zone; sim; named; definition; keep; layers; recorded; resumed; changed; sampling }

let settings =
  let open Options.Syntax in
  let+ network = Imc_options.chosen
  and+ adapters = Platform_options.adapters
  and+ speed = speed
  and+ seed = seed
  and+ answers = answers
  and+ supplier = supplier
  and+ supplier_timeout = supplier_timeout
  and+ journal = journal
  and+ drawing = drawing
  and+ no_socket = no_socket in
  { Run.network; adapters; speed; seed; answers; people = false; supplier; supplier_timeout; socket = not no_socket;
    recording = { journal; drawing; follower = None } }

let command =
  let info =
    Cmd.info "exec" ~docs:Options.s_run ~doc:"run a program, on a simulated fleet or on vehicles of a network" ~man
      ~exits:(Options.exits [ Done; Failed; Bad_input; Platform_trouble; Bug; Interrupted ])
  in
  Cmd.v info
    Term.(const run $ Verbosity.setup $ asked $ settings)
