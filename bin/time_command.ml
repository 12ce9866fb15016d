open Cmdliner
open Dolphin_app

module Timed_analysis = Time_analysis.Timed_analysis

let ( let* ) = Result.bind

(* {1 One question, or several} *)

let of_program ?from (settings : Time_analysis.settings) (program : Program_file.t) fleet ~slack ~json ~trace ~drawing =
  let { Time_analysis.deadline; _ } = settings in
  let ask ~interrupted ~progress =
    let outcome = Time_analysis.run ?from ~interrupted ~progress settings program fleet in
    (outcome, if slack then Some (Time_analysis.slacks ~interrupted ~progress settings program fleet outcome) else None)
  in
  let outcome, slacks = Watched.search ~json ask in
  let write path = Time_report.write_shown ?deadline program fleet path outcome in
  let traced = Option.fold trace ~none:(Ok ()) ~some:write in
  let draw drawing =
    Drawing.write_text drawing
      ~svg:(fun () -> Time_picture.svg ?deadline program outcome)
      ~html:(fun () -> Time_picture.html ?deadline program outcome)
  in
  let drawn = Option.fold drawing ~none:(Ok ()) ~some:draw in
  let as_json () = Time_report.to_json ?from ?deadline ?slacks program outcome in
  if json then print_endline (Dolphin_json.Canonical.to_string (as_json ()))
  else Time_report.print ?from ?deadline ?slacks program outcome;
  let* () = traced in
  let* () = drawn in
  let is_cut_short = Option.fold slacks ~none:false ~some:(fun (s : Timed_analysis.slacks) -> s.cut_short <> None) in
  Ok
    (Exit_status.of_verdict
       (match Timed_analysis.verdict ?deadline outcome with
        | Holds when is_cut_short -> Inconclusive
        | verdict -> verdict))

let of_values (settings : Time_analysis.settings) sweep fleet ~json =
  let { Time_analysis.deadline; _ } = settings in
  let ask ~interrupted ~progress =
    Sweep.rows sweep ~interrupted (fun program ->
        let outcome = Time_analysis.run ~interrupted ~progress settings program fleet in
        Ok (outcome, Time_sweep.verdict ?deadline outcome))
  in
  let* rows = Watched.search ~json ask in
  if json then print_endline (Dolphin_json.Canonical.to_string (Time_sweep.to_json ?deadline sweep rows))
  else Time_sweep.print ?deadline sweep rows;
  Ok (Exit_status.of_verdict (Sweep.verdict rows))

let of_fleets (settings : Time_analysis.settings) program fleet ~json =
  let { Time_analysis.deadline; _ } = settings in
  let ask ~interrupted ~progress = Fewest.find ~interrupted ~progress settings program fleet in
  let found = Watched.search ~json ask in
  if json then print_endline (Dolphin_json.Canonical.to_string (Fewest.to_json ?deadline program found))
  else Fewest.print ?deadline program fleet found;
  Exit_status.of_verdict (Fewest.verdict (fst found))

let no_slack = Error.Bad_input "--slack is for one program and its whole fleet: give no --fewest, and --set no range"

(* The rest of the run whose journal is [journal]. *)
let rest_of_run (settings : Time_analysis.settings) path set fleet ~journal ~slack ~fewest ~json ~trace ~drawing =
  if slack || fewest || trace <> None || drawing <> None then
    let options = "--slack, --fewest, --trace and --draw" in
    Error (Error.Bad_input (options ^ " are for runs from the beginning: leave them out with --from"))
  else
    let* from, program, fleet = Present.load path ~set ~fleet ~journal in
    Report.diagnostics ~source:program.source program.warnings;
    List.iter Report.complain (Present.remarks from program fleet @ Ignored_faults.sentences settings.faults fleet);
    of_program ~from settings program fleet ~slack ~json ~trace ~drawing

(* What is asked, and how it is shown. *)
type asked = {
  path : string;
  set : (string * string) list;
  fleet : string option;
  from : string option;
  slack : bool;
  fewest : bool;
  json : bool;
  trace : string option;
  drawing : Drawing.t option;
}

let run { path; set; fleet; from; slack; fewest; json; trace; drawing } (settings : Time_analysis.settings) =
  Report.result
    (let* () = Option.fold trace ~none:(Ok ()) ~some:Text_file.check in
     let* () = Option.fold drawing ~none:(Ok ()) ~some:Drawing.check in
     match from with
     | Some journal -> rest_of_run settings path set fleet ~journal ~slack ~fewest ~json ~trace ~drawing
     | None ->
       let* question = Sweep.question ~set path in
       let* fleet = Fleet_file.load_for ~program:path fleet in
       let* question = Sweep.within fleet question in
       let left_out = if fewest then Ignored_faults.sentences else Ignored_faults.of_time in
       List.iter Report.complain (left_out settings.faults fleet);
       match question with
       | Several _ when slack -> Error no_slack
       | One _ when slack && fewest -> Error no_slack
       | Several _ when fewest ->
         Error (Error.Bad_input "--fewest looks for the least fleet of one program: give --set no range with it")
       | Several _ when trace <> None || drawing <> None ->
         Error (Error.Bad_input "--trace and --draw are for one program: give --set no range of values")
       | One _ when fewest && (trace <> None || drawing <> None) ->
         Error (Error.Bad_input "--trace and --draw do not go with --fewest")
       | Several sweep -> of_values settings sweep fleet ~json
       | One program ->
         Report.diagnostics ~source:program.source program.warnings;
         if fewest then Ok (of_fleets settings program fleet ~json)
         else of_program settings program fleet ~slack ~json ~trace ~drawing)

let from =
  Options.from
    "Ask when the run $(docv) will be over, from where its journal ends, in times since its start: tasks and timers \
     have gone on since they began, and vehicles at rest stand where they were seen last. A task that should be over \
     already may take any time. Vehicles neither join nor leave by the fleet any more, and batteries are left out. \
     Not with $(b,--slack), $(b,--fewest), $(b,--trace) and $(b,--draw)."

let fewest =
  let doc =
    "Find the smallest part of the fleet with which all runs end, none fails, every property of $(mname) $(b,explore) \
     holds, and the $(b,--deadline) and each $(b,within) are met; and show a run that violates one of these with a \
     vehicle less. All smaller parts are checked."
  in
  Arg.(value & flag & info [ "fewest" ] ~doc)

let slack =
  let doc =
    "Also print for each task how much longer it may take, at its longest and in all its runs, without delaying the \
     latest end: $(b,any) if that end does not depend on it. Each task takes a few more searches."
  in
  Arg.(value & flag & info [ "slack" ] ~doc)

let deadline =
  let doc =
    "Check that all runs are over $(docv) after the start: a number of seconds, or a time as programs write it, such \
     as $(b,40.min). If not, a run that violates it is shown."
  in
  let parse text =
    match Time_analysis.duration text with Ok ms -> Ok ms | Error why -> Error (`Msg why) in
  let print ppf ms = Dolphin_time.Bounds.pp_time ppf ms in
  Arg.(value & opt (some (conv ~docv:"TIME" (parse, print))) None & info [ "deadline" ] ~docv:"TIME" ~doc)

let workers =
  let doc =
    "Search for slacks ($(b,--slack)) with $(docv) processes. The results are the same whatever $(docv) is. There is \
     one process with $(b,--max-memory)."
  in
  Options.workers ~doc

let trace =
  let doc =
    "Write the run shown into the file $(docv), without its times. $(mname) $(b,exec --follow) $(docv) replays it. If \
     its name ends in $(b,.itf.json), it is written in the Informal Trace Format instead. Nothing is written if no \
     run is shown."
  in
  Arg.(value & opt (some Explore_command.run_file) None & info [ "trace" ] ~docv:"FILE" ~doc)

let drawing =
  let doc =
    "Draw the possible times of tasks in the file $(docv), $(i,*.svg) or $(i,*.html): for each task a bar from its \
     earliest start to its latest end, dark where it runs in every run that has it; the ends of runs, and the \
     $(b,--deadline)."
  in
  Arg.(value & opt (some Options.drawing) None & info [ "draw" ] ~docv:"FILE" ~doc)

let man =
  [ `S Manpage.s_description;
    `P "$(tname) computes how long $(i,PROG) takes with the fleet: the earliest and latest end of its runs, and the \
        earliest and latest start and end of each task. It follows every run, as $(mname) $(b,explore) does, with a \
        clock for everything that is awaited. Each time printed is exact: some run has it.";
    `P "Tasks take the time given in the fleet: $(b,plan 'survey1', { duration 4.min, 7.min }). Plans that are \
        described in the program take the time of their way at the vehicle's speed, ten percent less or more, and of \
        their stays. Timers ($(b,idle), $(b,during), $(b,within), $(b,pause), time-outs of $(b,pick)) take exactly \
        their time. The program's own steps, answers and replies take none. Vehicles are present from the start, or \
        from the time of $(b,joins) in the fleet.";
    `P "For each $(b,within) of the program it reports whether it is met, or else shows a run that misses it.";
    `P "For each vehicle that runs a task it prints the least charge of its battery, at any time in any run. The \
        consumption under way and at rest is given by $(b,battery), $(b,drain) and $(b,charge) of the fleet, and by \
        $(b,charges) of its plans. If a battery runs empty in some run, that run is shown, and the verdict is \
        violated; if that is unknown, it is inconclusive.";
    `P "With a $(b,fence distance), it reports plans that may run at the same time and whose ways come nearer to each \
        other: the verdict is then violated, or inconclusive if vehicles know such a plan by its name only.";
    `P "With $(b,--faults), a task may fail at any time before its end; a vehicle without a link fails its task when \
        its connection timeout is over; a late vehicle comes before the time-out of the $(b,pick).";
    `P "It prints a run that ends last, in columns with times, and the durations that its end depends on. If some run \
        never ends, it prints a run to a place from which it loops without end, or after which nothing more happens. \
        It lists everything whose duration is unknown.";
    `P "Progress goes to standard error. A bound that is met, or Ctrl-C, makes the verdict inconclusive.";
    `S Manpage.s_arguments;
    `S Manpage.s_options;
    `S Manpage.s_exit_status;
    `S Manpage.s_examples;
    `Pre "  $(mname) $(tname) examples/rendezvous.dol\n  $(mname) $(tname) examples/rendezvous.dol --deadline 20.min\n\
         \  $(mname) $(tname) mission.dol --from latest";
    `P "The number of vehicles needed, for a program with a parameter for the number that it picks, and for a part of \
        the fleet:";
    `Pre "  $(mname) $(tname) mission.dol --set vehicles=1..8 --deadline 40.min\n\
         \  $(mname) $(tname) mission.dol --fewest --deadline 40.min" ]
  @ Options.see_also

let json = Arg.(value & flag & info [ "json" ] ~doc:"Print the result as one JSON object.")

let asked =
  let open Options.Syntax in
  let+ path = Options.program
  and+ set = Options.set_range
  and+ fleet = Options.fleet
  and+ from = from
  and+ slack = slack
  and+ fewest = fewest
  and+ json = json
  and+ trace = trace
  and+ drawing = drawing in
  { path; set; fleet; from; slack; fewest; json; trace; drawing }

let settings =
  let open Options.Syntax in
  let+ answers = Explore_command.answers
  and+ faults = Explore_command.faults
  and+ deadline = deadline
  and+ workers = workers
  and+ max_states = Explore_command.max_states
  and+ max_depth = Explore_command.max_depth
  and+ max_memory = Explore_command.max_memory
  and+ timeout = Explore_command.timeout in
  { Time_analysis.answers; faults; deadline; workers; max_states; max_depth; max_memory; timeout }

let command =
  let info =
    Cmd.info "time" ~docs:Options.s_prove ~doc:"compute how long a program takes, at most and at least" ~man
      ~exits:(Options.exits [ Done; Violated; Bad_input; Inconclusive; Platform_trouble; Bug ])
  in
  Cmd.v info
    Term.(const run $ asked $ settings)
