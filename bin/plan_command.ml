open Cmdliner
open Dolphin_app
open Dolphin_runtime
module Safe_print = Dolphin_display.Safe_print

let ( let* ) = Result.bind

let names found =
  String.concat ", " (List.sort_uniq compare (List.map (fun (f : Inline_plans.found) -> f.name) found))

let show definition plan = print_endline (Dolphin_json.Canonical.to_lines (Inline_plans.to_json definition plan))

let tell_end : Driver.outcome -> unit = function
  | Ended Completed -> ()
  | (Ended (Halted _ | Failed _ | Interrupted) | Stuck _ | Spins _) as outcome ->
    let why = Format.asprintf "%a" Driver.pp_outcome outcome in
    Report.complain ("the run that determines the plans did not complete: " ^ why)

let print_named definition name found outcome : Exit_status.t =
  let inline = List.filter (fun (f : Inline_plans.found) -> f.plan <> None) found in
  match List.filter (fun (f : Inline_plans.found) -> f.name = name) found with
  | [] ->
    tell_end outcome;
    Report.complain
      (Printf.sprintf "no vehicle is given a plan '%s'; %s" name
         (if inline = [] then "none gets an inline plan" else "inline plans are " ^ names inline));
    Failed
  | plans -> (
      match List.filter_map (fun (f : Inline_plans.found) -> f.plan) plans with
      | [] ->
        Report.complain
          (Printf.sprintf "'%s' is a plan known to vehicles by name: the program does not describe it" name);
        Failed
      | plans -> List.iter (show definition) plans; Done)

let print_all fences found outcome : Exit_status.t =
  tell_end outcome;
  let told (b : Dolphin_plans.Fences.breach) = "\n  " ^ b.message in
  let line (f : Inline_plans.found) =
    match f.plan with
    | Some plan ->
      Format.asprintf "%a%s" Dolphin_plans.Inline_plan.pp plan
        (Option.fold ~none:"" ~some:told (Inline_plans.broken fences f))
    | None -> f.name ^ " (by name)"
  in
  List.iter (fun f -> Safe_print.line (line f)) found;
  Done

let print_summary fences name found outcome : Exit_status.t =
  match name, List.filter (fun (f : Inline_plans.found) -> name = None || name = Some f.name) found with
  | Some name, [] -> print_named None name found outcome
  | (Some _ | None), chosen -> 
    print_endline (Dolphin_json.Canonical.to_string (Inline_plans.summary fences chosen outcome));
    Done

(* The verdicts of adapters on the plans; a command that gets them prints them at once. *)
let print_checked adapters name found =
  let is_wanted (f : Inline_plans.found) = name = None || name = Some f.name in
  let chosen = List.filter is_wanted found in
  match name, chosen with
  | Some name, [] -> Error (Error.Bad_input (Printf.sprintf "no vehicle is given a plan '%s'" name))
  | (Some _ | None), _ ->
    let* verdicts = Platform_options.ask adapters chosen in
    if name <> None then
      List.iter (fun f -> print_endline (Dolphin_json.Canonical.to_lines (Adapter_check.to_json f))) chosen;
    List.iter (fun v -> List.iter Safe_print.line (Adapter_check.lines v)) verdicts;
    Ok (if List.for_all Adapter_check.is_fine verdicts then Exit_status.Done else Failed)

(* {1 For maps} *)

let write_map (export : Export_options.t) path name found : (Exit_status.t, Error.t) result =
  let* format = Export_options.format export in
  let chosen = List.filter (fun (f : Inline_plans.found) -> name = None || name = Some f.name) found in
  let by_name = List.filter (fun (f : Inline_plans.found) -> f.plan = None) chosen in
  if by_name <> [] then
    Report.complain
      (Printf.sprintf "left out, since only vehicles know their way: %s" (names by_name));
  let title = Filename.basename path in
  let* () =
    match name, chosen with
    | Some name, [] -> Error (Error.Bad_input (Printf.sprintf "no vehicle is given a plan '%s'" name))
    | (Some _ | None), _ -> Exported.write format export.path (Exported.of_plans ~title chosen)
  in
  Ok Exit_status.Done

(* {1 The command} *)

type asked = {
  path : string;
  name : string option;  (** the plan's; [None]: all are listed *)
  is_export : bool;
  export : Export_options.t;
  set : (string * string) list;
  fleet : string option;
  seed : int;
  answers : string list;
  json : bool;
  adapters : string list;
  definition : string option;
}

let run () { path; name; is_export; export; set; fleet; seed; answers; json; adapters; definition } =
  Report.result
    (let* program, fleet = Program_file.load_with_fleet ~set ~fleet path in
     let* definition = Definition_file.load definition in
     Report.diagnostics ~source:program.source program.warnings;
     let* () =
       if json && (is_export || adapters <> []) then
         Error (Error.Bad_input "--json prints a summary of plans: it excludes export and --platform")
       else Ok () in
     let found, outcome = Inline_plans.of_run program fleet ~seed ~answers in
     match adapters, name with
     | _, _ when json -> Ok (print_summary program.program.fences name found outcome)
     | _, _ when is_export -> tell_end outcome; write_map export path name found
     | _ :: _, _ -> tell_end outcome; print_checked adapters name found
     | [], Some name -> Ok (print_named definition name found outcome)
     | [], None -> Ok (print_all program.program.fences found outcome))

(* [export] before the program is a word of the command: a group of commands could not have a program there. *)
let arguments =
  let at position ~docv doc = Arg.(value & pos position (some string) None & info [] ~docv ~doc) in
  let program = at 0 ~docv:"PROG" "The program, a file such as $(i,mission.dol)." in
  let plan =
    at 1 ~docv:"NAME" "The plan's name, as $(b,planName) gives it. Without it, the plans that vehicles are given are \
                       listed." in
  let further = Arg.(value & pos_right 1 string [] & info []) in
  let arrange first second further =
    match first, second, further with
    | Some "export", Some path, [] -> `Ok (true, path, None)
    | Some "export", Some path, [ name ] -> `Ok (true, path, Some name)
    | Some path, name, [] when path <> "export" || Sys.file_exists path -> `Ok (false, path, name)
    | (Some _ | None), _, (_ :: _ as more) ->
      `Error (true, "too many arguments, don't know what to do with '" ^ List.nth more (List.length more - 1) ^ "'")
    | (Some _ | None), _, [] -> `Error (true, "required argument PROG is missing")
  in
  let open Term in
  ret (const arrange $ program $ plan $ further)

let seed =
  let doc = "The seed of the random numbers of the run that determines the plans." in
  Arg.(value & opt int 0 & info [ "seed" ] ~docv:"N" ~doc)

let answers =
  let doc = "Answer a question of the program with $(docv). May be repeated." in
  Arg.(value & opt_all string [] & info [ "answer" ] ~docv:"TEXT" ~doc)

let json =
  let doc =
    "Print a summary of the plans as one JSON object: the vehicle of each, and the way of those that the program \
     describes, maneuver by maneuver; if the run did not complete, the reason."
  in
  Arg.(value & flag & info [ "json" ] ~doc)

let asked =
  let open Options.Syntax in
  let+ named_export, path, name = arguments
  and+ export = Export_options.term
  and+ set = Options.set
  and+ fleet = Options.fleet
  and+ seed = seed
  and+ answers = answers
  and+ json = json
  and+ adapters = Platform_options.checking
  and+ definition = Imc_options.definition in
  let is_export = named_export || export.format <> None || export.path <> None in
  { path; name; is_export; export; set; fleet; seed; answers; json; adapters; definition }

let man =
  [ `S Manpage.s_synopsis;
    `P "$(mname) $(tname) [$(i,OPTION)]... $(i,PROG) [$(i,NAME)]";
    `P "$(mname) $(tname) $(b,export) [$(i,OPTION)]... $(b,--to) $(i,FORMAT) $(i,PROG) [$(i,NAME)]";
    `S Manpage.s_description;
    `P "$(tname) prints the inline plan $(i,NAME) of the program $(i,PROG) as IMC vehicles get it: a \
        PlanSpecification, in JSON. Angles are in radians there, lengths in metres, times in seconds. A mission of \
        items is printed as adapters of $(b,--platform) get it.";
    `P "A plan depends on the values that the program computes. So the program is run on simulated vehicles, without \
        waiting, as $(mname) $(b,exec) does without $(b,--imc), and the plans are those given to vehicles in that \
        run. A plan that is not started in it is not found: another fleet, seed or answer may lead to it. If vehicles \
        are given different plans of one name, all are printed.";
    `P "With $(b,--platform) the plans are not printed for IMC: adapters report the problems that keep their vehicles \
        from running them, and nothing moves.";
    `P "$(tname) $(b,export), or $(b,--to) $(i,FORMAT), writes the plans for other programs: the way of each plan \
        through its way points, and the end of each of its maneuvers. A plan known by name has no way to write.";
    Export_options.man;
    `S Manpage.s_arguments;
    `S Manpage.s_options;
    `S Imc_options.s_network;
    `S Manpage.s_exit_status;
    `S Manpage.s_examples;
    `Pre "  $(mname) $(tname) examples/water_survey.dol\n  $(mname) $(tname) examples/water_survey.dol waterSurvey\n\
         \  $(mname) $(tname) export examples/water_survey.dol -o survey.kml" ]
  @ Options.see_also

let command =
  let info =
    Cmd.info "plan" ~docs:Options.s_run ~doc:"print an inline plan as IMC vehicles get it" ~man
      ~exits:(Options.exits [ Done; Failed; Bad_input; Platform_trouble; Bug; Interrupted ])
  in
  Cmd.v info Term.(const run $ Verbosity.setup $ asked)
