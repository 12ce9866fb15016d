open Cmdliner
module Model = Dolphin_tla.Model
module Scenario = Dolphin_scenario.Scenario

let ( let* ) = Result.bind

let model (program : Program_file.t) (fleet : Fleet_file.t) ~answers ~faults =
  let scenario = fleet.scenario in
  let plans = List.map (fun (plan : Scenario.plan) -> plan.name) scenario.plans in
  let prompts = List.map (fun (answer : Scenario.answer) -> answer.prompt) scenario.answers in
  let environment = World_of.environment ~answers ~faults scenario in
  Model.of_program ~plans ~prompts ~environment (World_of.world scenario) program.program

let load path fleet =
  match Program_file.load path, Fleet_file.load (Fleet_file.choose ~program:path fleet) with
  | Error trouble, _ -> Program_file.tell trouble; Error Exit_status.Bad_input
  | Ok _, Error trouble -> Fleet_file.tell trouble; Error Exit_status.Bad_input
  | Ok program, Ok fleet -> Ok (program, fleet)

let rec make_directory path =
  if not (Sys.file_exists path) then begin
    make_directory (Filename.dirname path);
    Sys.mkdir path 0o777
  end

let write_file directory (file : Model.file) =
  let channel = open_out_bin (Filename.concat directory file.name) in
  Fun.protect ~finally:(fun () -> close_out channel) (fun () -> output_string channel file.text)

let write directory files =
  match
    make_directory directory;
    List.iter (write_file directory) files
  with
  | () -> Exit_status.Done
  | exception Sys_error why -> Report.complain why; Platform_trouble

let run path fleet answers faults directory =
  let result =
    let* program, fleet = load path fleet in
    match model program fleet ~answers ~faults with
    | Ok files -> Ok (write directory files)
    | Error refusals -> Report.diagnostics ~source:program.source refusals; Error Exit_status.Bad_input
  in
  match result with Ok status | Error status -> status

(* {1 The command} *)

let directory =
  let doc = "Write the model into the directory $(docv), which is made if it is not there." in
  Arg.(required & opt (some string) None & info [ "o"; "output" ] ~docv:"DIR" ~doc)

let man =
  [ `S Manpage.s_description;
    `P "$(tname) writes a model of a program in its world in TLA+, for the model checker TLC: $(b,MC.tla), which is the \
        program as a table of expressions and the world as constants, and the modules of the specification of the language \
        that it extends, of which $(b,Dolphin.tla) is the semantics, rule by rule. The world is that of $(mname) $(b,explore), \
        and TLC finds the same states and transitions.";
    `P "$(b,MC.cfg) checks the properties, $(b,Graph.cfg) prints the state graph. In the directory, with TLC's jar:";
    `Pre "  java -Xss64m -cp tla2tools.jar tlc2.TLC -config MC.cfg MC.tla\n\
         \  java -Xss64m -cp tla2tools.jar tlc2.TLC -workers 1 -config Graph.cfg MC.tla";
    `P "What has no meaning in TLA+ is refused, with its place in the program: calls of a supplier, and coordinates that the \
        program computes.";
    `S Manpage.s_arguments;
    `S Manpage.s_options;
    `S Manpage.s_exit_status;
    `S Manpage.s_examples;
    `Pre "  $(mname) $(tname) examples/rendezvous.dol -o rendezvous\n\
         \  $(mname) $(tname) examples/rendezvous.dol --faults fail=1 -o rendezvous" ]
  @ Options.see_also

let command =
  let info =
    Cmd.info "tla" ~doc:"write a program as a model in TLA+" ~man
      ~exits:(Options.exits [ Done; Bad_input; Platform_trouble; Bug ])
  in
  Cmd.v info
    Term.(const run $ Options.program $ Options.fleet $ Explore_command.answers $ Explore_command.faults $ directory)
