open Cmdliner
open Dolphin_app
module Safe_print = Dolphin_display.Safe_print

let ( let* ) = Result.bind

(* A terminal's own width; for other outputs, the user's. *)
let columns () =
  if Unix.isatty Unix.stdout then snd (Dolphin_display.Terminal.size Unix.stdout)
  else Option.value (Option.bind (Sys.getenv_opt "COLUMNS") int_of_string_opt) ~default:80

(* Choices and traces may quote texts from anywhere. *)
let print = Safe_print.line

(* Text typed on a terminal stands there already. *)
let read prompt =
  print_string prompt;
  flush stdout;
  let echo line = if not (Unix.isatty Unix.stdin) then print line in
  match input_line stdin with
  | line -> echo line; Some line
  | exception End_of_file -> print_newline (); None

type asked = {
  path : string;
  set : (string * string) list;
  fleet : string option;
  answers : string list;
  faults : Dolphin_environment.Faults.t;
  trace : string option;  (** the file of a run that is stepped through *)
}

let run { path; set; fleet; answers; faults; trace } =
  Report.result
    (let recorded = Option.bind trace Witness_file.settings in
     let* program, fleet = Program_file.load_with_fleet ~set ?recorded ~fleet path in
     Report.diagnostics ~source:program.source program.warnings;
     let* () = Walk_session.run ~read ~print ~columns program fleet ~answers ~faults ~trace in
     Ok Exit_status.Done)

let trace =
  let doc =
    "Load the run recorded in $(docv), as $(mname) $(b,explore --trace) $(docv) and $(b,write) write it, for stepping \
     forward. The world has to allow it: give the same $(b,--faults)."
  in
  Arg.(value & opt (some string) None & info [ "trace" ] ~docv:"FILE" ~doc)

let asked =
  let open Options.Syntax in
  let+ path = Options.program
  and+ set = Options.set
  and+ fleet = Options.fleet
  and+ answers = Explore_command.answers
  and+ faults = Explore_command.faults
  and+ trace = trace in
  { path; set; fleet; answers; faults; trace }

let man =
  let typed (what, meaning) = `I ("$(b," ^ what ^ ")", meaning ^ ".") in
  [ `S Manpage.s_description;
    `P "$(tname) lets you play the environment: it shows the state of $(i,PROG) and numbers the possible steps, by \
        the transition function of $(mname) $(b,exec), in the world of $(mname) $(b,explore): each step of the \
        program, each end of a task, each choice of vehicles, each sensor reading. You type the number of a choice.";
    `P "A state consists of A, the tasks that vehicles run; B, the vehicles that the program holds; N, the pairs of \
        the tuple space; the rest of the task that is executed; and the events that the program waits for.";
    `S "WHAT YOU TYPE" ]
  @ List.map typed Walk_session.help
  @ [ `P "Words may be shortened, to one letter if you like.";
      `S Manpage.s_examples;
      `Pre "  $(mname) $(tname) examples/rendezvous.dol --faults fail=1\n\
           \  $(mname) explore mission.dol --faults loss --trace lost.run\n\
           \  $(mname) $(tname) mission.dol --faults loss --trace lost.run" ]
  @ Options.see_also

let command =
  let info =
    Cmd.info "walk" ~docs:Options.s_prove ~doc:"take a run of a program step by step, by hand" ~man
      ~exits:(Options.exits [ Done; Bad_input; Bug ])
  in
  Cmd.v info Term.(const run $ asked)
