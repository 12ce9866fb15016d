open Cmdliner
open Dolphin_app

let ( let* ) = Result.bind

(* {1 What is done with the model} *)

type task =
  | Write of string  (** into this directory *)
  | Check of Tlc_check.settings
  | Compare of { directory : string option; limit : int; coverage : bool }

let write directory files =
  let files = List.map (fun (f : Dolphin_tla.Model.file) -> (f.name, f.text)) files in
  Result.map (fun () -> Exit_status.Done) (Tlc_session.write ~directory files)

let task directory ~check ~compare ~strict ~limit ~workers ~distributed ~coverage =
  let wrong why = Error (Error.Bad_input why) in
  let check_by mode = Ok (Check { mode; directory; strict; notice = prerr_endline }) in
  let only_with_run =
    List.filter_map
      (fun (given, option) -> if given then Some option else None)
      [ (strict, "--strict"); (distributed <> None, "--distributed"); (workers <> None, "--workers") ]
  in
  match check, compare, only_with_run, directory, distributed, workers with
  | _, false, _, _, _, _ when coverage -> wrong "--coverage needs --compare"
  | true, true, _, _, _, _ -> wrong "--run and --compare exclude each other: give one of them"
  | false, _, option :: _, _, _, _ -> wrong (option ^ " needs --run")
  | true, false, _, _, Some _, Some _ ->
    wrong "--workers is not for --distributed: each worker has its own number of threads"
  | true, false, _, _, Some (host, port), None ->
    check_by (Server { host; port })
  | true, false, _, _, None, _ ->
    check_by (Local (Option.value workers ~default:Dolphin_tlc.Invocation.Automatic))
  | false, true, [], _, _, _ -> Ok (Compare { directory; limit; coverage })
  | false, false, [], Some directory, _, _ -> Ok (Write directory)
  | false, false, [], None, _, _ ->
    wrong "give -o DIR to write the model, --run to check it by TLC, or --compare to compare state graphs"

let perform jar task program ({ files; environment; world } : Tla_model.t) =
  match task with
  | Write directory -> write directory files
  | Check settings ->
    let* installation = Tlc_session.installation jar in
    Result.map Exit_status.of_verdict (Tlc_check.run installation settings files environment program world)
  | Compare { directory; limit; coverage } ->
    let* installation = Tlc_session.installation jar in
    Result.map Exit_status.of_verdict
      (Tlc_compare.run installation ~directory ~limit ~coverage files environment program world)

(* The model that is asked for. *)
type asked = {
  path : string;
  set : (string * string) list;
  fleet : string option;
  answers : string list;
  faults : Dolphin_environment.Faults.t;
  tick : int option;
}

let run { path; set; fleet; answers; faults; tick } jar task =
  Report.result
    (let* task = task in
     let* program, fleet = Program_file.load_with_fleet ~set ~fleet path in
     let* model = Tla_model.make ?tick ~answers ~faults program fleet in
     perform jar task program model)

(* {1 The command} *)

let directory =
  let doc =
    "Write the model into the directory $(docv), which is made if needed. With $(b,--run) and $(b,--compare) the \
     model and TLC's output are kept there."
  in
  Arg.(value & opt (some string) None & info [ "o"; "output" ] ~docv:"DIR" ~doc)

let tick =
  let doc =
    "The tick of time in $(b,MCTimed.tla), such as $(b,1.min) or $(b,30): all times must be multiples of it. By \
     default it is the longest tick that divides the durations of the fleet's plans."
  in
  let parse text =
    match Time_analysis.duration text with
    | Ok 0 -> Error (`Msg "a tick takes more than 0 seconds")
    | Ok ms -> Ok ms
    | Error why -> Error (`Msg why)
  in
  let time = Arg.conv ~docv:"TIME" (parse, Dolphin_time.Bounds.pp_time) in
  Arg.(value & opt (some time) None & info [ "tick" ] ~docv:"TIME" ~doc)

let check = Arg.(value & flag & info [ "run" ] ~doc:"Have TLC check the model, and print its verdicts.")

let compare =
  let doc = "Have TLC print the state graph, and compare it with the explorer's." in
  Arg.(value & flag & info [ "compare" ] ~doc)

let strict =
  let doc = "With $(b,--run): count as violations $(b,halt) and tuples left over." in
  Arg.(value & flag & info [ "strict" ] ~doc)

let limit =
  let doc = "With $(b,--compare): give up after $(docv) states." in
  Arg.(value & opt int 1_000_000 & info [ "max-states" ] ~docv:"N" ~doc)

let man =
  [ `S Manpage.s_description;
    `P "$(tname) writes a model of a program in its world in TLA+, for the model checker TLC: $(b,MC.tla), the \
        program as a table of expressions and the world as constants, and the modules of the language's specification \
        that it extends, of which $(b,Dolphin.tla) is the semantics, rule by rule. The world is that of $(mname) \
        $(b,explore), with the same $(b,--faults) and with open sensor readings: TLC finds the states and transitions \
        of $(mname) $(b,explore --reduction none).";
    `P "$(b,MC.cfg) checks the properties; $(b,Told.cfg) too, and has TLC show the observable part of each state of a \
        run, and the label and the rules of each transition (by an $(b,ALIAS), which the TLC of $(b,make tlc) does \
        not support yet); $(b,Graph.cfg) prints the state graph; $(b,Coverage.cfg) has an action for each rule, for \
        TLC to count. In the directory, with TLC's jar:";
    `Pre "  java -Xss64m -cp tla2tools.jar tlc2.TLC -config MC.cfg MC.tla\n\
         \  java -Xss64m -cp tla2tools.jar tlc2.TLC -workers 1 -config Graph.cfg MC.tla\n\
         \  java -Xss64m -cp tla2tools.jar tlc2.TLC -config Coverage.cfg -coverage 1 MC.tla";
    `P "$(b,MCTimed.tla) is the program with the times of the fleet, in ticks ($(b,--tick)). With $(b,Timed.cfg), TLC \
        prints the dates at which runs end, and tasks start, end, fail and are stopped: a line for each date that is \
        earlier or later than all before. The first and the last are those of $(mname) $(b,time), in ticks:";
    `Pre "  java -Xss64m -cp tla2tools.jar tlc2.TLC -workers 1 -config Timed.cfg MCTimed.tla";
    `P "Programs without a meaning in TLA+ are refused, with the place in the program or in the fleet: coordinates \
        that the program computes, or numbers in replies that TLC does not have. Other limits show only during the \
        check, and end it with status 3: numbers too large for TLC, and sensor readings used other than in \
        comparisons.";
    `S "RUNNING TLC";
  ]
  @ Tlc_options.man
  @ [
    `S Manpage.s_arguments;
    `S Manpage.s_options;
    `S Manpage.s_exit_status;
    `S Manpage.s_examples;
    `Pre "  $(mname) $(tname) examples/rendezvous.dol -o rendezvous\n\
         \  $(mname) $(tname) examples/rendezvous.dol --run --faults fail=1\n\
         \  $(mname) $(tname) examples/rendezvous.dol --compare" ]
  @ Options.see_also

let asked =
  let open Options.Syntax in
  let+ path = Options.program
  and+ set = Options.set
  and+ fleet = Options.fleet
  and+ answers = Explore_command.answers
  and+ faults = Explore_command.faults
  and+ tick = tick in
  { path; set; fleet; answers; faults; tick }

let task =
  let open Options.Syntax in
  let+ directory = directory
  and+ check = check
  and+ compare = compare
  and+ strict = strict
  and+ limit = limit
  and+ workers = Tlc_options.workers
  and+ distributed = Tlc_options.distributed
  and+ coverage = Tlc_options.coverage in
  task directory ~check ~compare ~strict ~limit ~workers ~distributed ~coverage

let command =
  let info =
    Cmd.info "tla" ~docs:Options.s_prove ~doc:"write a program as a model in TLA+, and have TLC check it" ~man
      ~exits:(Options.exits [ Done; Violated; Bad_input; Inconclusive; Platform_trouble; Bug ])
  in
  Cmd.v info
    Term.(const run $ asked $ Tlc_options.jar $ task)
