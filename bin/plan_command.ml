open Cmdliner
open Dolphin_semantics
open Dolphin_runtime
module Simulator = Dolphin_platform_sim.Simulator

(* The plans that vehicles were given in a run, first one first; a name without a plan is one that vehicles know. *)
type found = { name : string; plan : Plan.t option }

(* A run in virtual time is over at once, unless it never is. *)
let most_transitions = 200_000

let plans_of (program : Program_file.t) (fleet : Fleet_file.t) ~seed ~answers =
  let found = ref [] and count = ref 0 in
  let enough, stop = Lwt.wait () in
  let effect : Effect.t -> unit = function
    | Start (_, { name; plan; _ }) -> if not (List.mem { name; plan } !found) then found := { name; plan } :: !found
    | Stop _ | Set_timer _ | Cancel_timer _ | Look_for _ | Bind _ | Release _ | Set_connection_timeout _ | Say _ | Ask _
    | Call_host _ | End _ -> ()
  in
  let transition ~time:_ ~cause:_ (t : Transition.t) =
    List.iter effect t.effects;
    incr count;
    if !count = most_transitions then Lwt.wakeup_later stop ()
  in
  let shown = { Questions.ask = ignore; answered = ignore; refused = ignore } in
  let run =
    Driver.run
      (module Simulator.Virtual)
      (Simulator.Virtual.create ~seed fleet.scenario)
      ~observer:{ Observer.nobody with transition }
      ~console:(Questions.console shown ~answered:[] ~answers ~scenario:fleet.scenario)
      ~interruption:enough program.program
  in
  let outcome = Lwt_main.run run in
  (List.rev !found, outcome)

let names found = String.concat ", " (List.sort_uniq compare (List.map (fun f -> f.name) found))

(* By the user's definition, if there is one. *)
let show definition (plan : Plan.t) =
  let message = Dolphin_imc.Message.Plan_specification (Dolphin_platform_imc.Plan_message.of_plan plan) in
  let json =
    match definition with
    | None -> Dolphin_imc.Message.to_json message
    | Some d -> Dolphin_imc.Dynamic.message_to_json d message
  in
  print_endline (Yojson.Safe.pretty_to_string json)

let tell_end : Driver.outcome -> unit = function
  | Ended Completed -> ()
  | (Ended (Halted _ | Failed _ | Interrupted) | Stuck _) as outcome ->
    let why = Format.asprintf "%a" Driver.pp_outcome outcome in
    Report.complain ("the run that the plans are taken from did not complete: " ^ why)

let print_named definition name found outcome : Exit_status.t =
  let inline = List.filter (fun f -> f.plan <> None) found in
  match List.filter (fun f -> f.name = name) found with
  | [] ->
    tell_end outcome;
    Report.complain
      (Printf.sprintf "no vehicle is given a plan '%s'; %s" name
         (if inline = [] then "none gets an inline plan" else "inline plans are " ^ names inline));
    Failed
  | plans -> (
      match List.filter_map (fun f -> f.plan) plans with
      | [] ->
        Report.complain
          (Printf.sprintf "'%s' is a plan that vehicles know by name: the program does not describe it" name);
        Failed
      | plans -> List.iter (show definition) plans; Done)

let print_all found outcome : Exit_status.t =
  tell_end outcome;
  List.iter
    (fun f ->
       let what = match f.plan with Some plan -> Format.asprintf "%a" Plan.pp plan | None -> f.name ^ " (by name)" in
       print_endline what)
    found;
  Done

let run path name fleet seed answers definition =
  match
    Program_file.load path, Fleet_file.load (Fleet_file.choose ~program:path fleet), Imc_definition.load definition
  with
  | Error trouble, _, _ -> Program_file.tell trouble; Exit_status.Bad_input
  | Ok _, Error trouble, _ -> Fleet_file.tell trouble; Exit_status.Bad_input
  | Ok _, Ok _, Error status -> status
  | Ok program, Ok fleet, Ok definition -> (
      Report.diagnostics ~source:program.source program.warnings;
      let found, outcome = plans_of program fleet ~seed ~answers in
      match name with
      | Some name -> print_named definition name found outcome
      | None -> print_all found outcome)

let plan_name =
  let doc = "The plan's name, as $(b,planName) gives it. Without it, the plans that vehicles are given are listed." in
  Arg.(value & pos 1 (some string) None & info [] ~docv:"NAME" ~doc)

let seed =
  let doc = "What chance depends on in the run that the plans are taken from." in
  Arg.(value & opt int 0 & info [ "seed" ] ~docv:"N" ~doc)

let answers =
  let doc = "Answer a question of the program with $(docv). May be repeated." in
  Arg.(value & opt_all string [] & info [ "answer" ] ~docv:"TEXT" ~doc)

let man =
  [ `S Manpage.s_description;
    `P "$(tname) prints the inline plan $(i,NAME) of the program $(i,PROG) as IMC vehicles get it: a \
        PlanSpecification, in JSON. Angles are in radians there, lengths in metres, times in seconds.";
    `P "What a plan is depends on what the program computes. So the program is run, on simulated vehicles and in no \
        time, as $(mname) $(b,exec) does without $(b,--imc), and the plans are those that vehicles are given in that \
        run. A plan that is not started in it is not found: another fleet, seed or answer may lead to it. If vehicles \
        are given different plans of one name, all are printed.";
    `S Manpage.s_arguments;
    `S Manpage.s_options;
    `S Imc_options.s_network;
    `S Manpage.s_exit_status;
    `S Manpage.s_examples;
    `Pre "  $(mname) $(tname) examples/water_survey.dol\n  $(mname) $(tname) examples/water_survey.dol waterSurvey" ]
  @ Options.see_also

let command =
  let info =
    Cmd.info "plan" ~doc:"print an inline plan as IMC vehicles get it" ~man
      ~exits:(Options.exits [ Done; Failed; Bad_input; Bug ])
  in
  Cmd.v info Term.(const run $ Options.program $ plan_name $ Options.fleet $ seed $ answers $ Imc_definition.file)
