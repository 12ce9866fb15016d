open Cmdliner
open Dolphin_app
module Safe_print = Dolphin_display.Safe_print

let verdict path found = Safe_print.format "%s: %s@." path (Report.counts found)

(* Reports the faults of the file [path], if it can be read at all. *)
let checked path = function
  | Ok x -> Some x
  | Error e ->
    Report.tell e;
    (match path, Error.diagnostics e with
     | Some path, (_ :: _ as found) -> verdict path found
     | Some _, [] | None, _ -> ());
    None

(* The verdicts of adapters on the plans that a run of the program gives vehicles. *)
let checked_plans program fleet = function
  | [] -> Exit_status.Done
  | adapters ->
    let found, _ = Inline_plans.of_run program fleet ~seed:0 ~answers:[] in
    match Platform_options.ask adapters found with
    | Error (Error.Interrupted _ as e) -> Report.error e
    | Error e -> Report.tell e; Bad_input
    | Ok verdicts ->
      List.iter (fun v -> List.iter Safe_print.line (Adapter_check.lines v)) verdicts;
      if List.for_all Adapter_check.is_fine verdicts then Done else Bad_input

let run path set fleet adapters =
  let program = checked (Some path) (Program_file.load ~set path) in
  let chosen = Fleet_file.choose ~program:path fleet in
  let fleet = checked chosen (Fleet_file.load chosen) in
  let within fleet program = checked (Some path) (Program_file.within fleet program) in
  let program = match fleet with Some fleet -> Option.bind program (within fleet) | None -> program in
  let of_plans = match program, fleet with
    | Some p, Some f ->
      Dolphin_service.Plan_names.misspelt p.program f.scenario
      @ Dolphin_service.Timeless_loops.found ~plans:(p.plans ~place:p.program.place) p.ast f.scenario
      @ Dolphin_service.Foreseen.found ~own_fleet:(f.path <> None) p.program f.scenario
    | _, _ -> []
  in
  Option.iter
    (fun (p : Program_file.t) ->
       let found = p.warnings @ of_plans in
       Report.diagnostics ~source:p.source found;
       verdict path found)
    program;
  Option.iter (fun (f : Fleet_file.t) -> Option.iter (fun path -> verdict path []) f.path) fleet;
  let is_error (d : Dolphin_syntax.Diagnostic.t) = d.severity = Error in
  match program, fleet with
  | Some _, Some _ when List.exists is_error of_plans -> Exit_status.Bad_input
  | Some program, Some fleet -> checked_plans program fleet adapters
  | None, _ | _, None -> Exit_status.Bad_input

let man =
  [ `S Manpage.s_description;
    `P "$(tname) finds the faults of a program that show without running it: syntax, unknown names, numbers of \
        arguments, kinds of literals, statements of the script inside a task's code, one vehicle needed twice at \
        once. It shows each fault with its line and, if known, a correction. $(b,exec) makes these checks before it \
        starts.";
    `P "It also follows the program for as long as only one thing can happen. If the program ends with an error there, \
        that is an error if nothing of the outside took part in it, else a warning about its fleet.";
    `P "With $(b,--platform), adapters report the problems that keep their vehicles from running the program's plans: \
        the plans given to vehicles in a run on the simulated fleet. Nothing moves.";
    `P "The fleet that the program would run with is checked too. Plan names that look misspelt are reported, and \
        endless loops whose rounds take no time with this fleet.";
    `S Manpage.s_files;
    `I ("$(i,PROG) with the ending $(b,.fleet)", "The fleet, unless $(b,--fleet) names another.");
    `S Manpage.s_examples;
    `Pre "  $(mname) $(tname) mission.dol\n  $(mname) $(tname) mission.dol --fleet harbour.fleet" ]
  @ Options.see_also

let command =
  let info =
    Cmd.info "check" ~docs:Options.s_write ~doc:"find the faults of a program without running it" ~man
      ~exits:(Options.exits [ Done; Bad_input; Bug; Interrupted ])
  in
  Cmd.v info Term.(const run $ Options.program $ Options.set $ Options.fleet $ Platform_options.checking)
