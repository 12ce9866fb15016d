open Cmdliner
open Dolphin_app

let ( let* ) = Result.bind

let load set fleet settings path =
  let* program, fleet = Program_file.load_with_fleet ~set ~fleet path in
  Successor_service.create ~version:Version.number settings program fleet

let done_ result = Result.map (fun () -> Exit_status.Done) result

type asked = {
  path : string;
  set : (string * string) list;
  fleet : string option;
  settings : Successor_service.settings;
  show_greeting : bool;
  show_run : bool;
}

let run { path; set; fleet; settings; show_greeting; show_run } =
  Sys.set_signal Sys.sigint (Signal_handle (fun _ -> Exit_status.exit_interrupted ()));
  Minor_heap.enlarge ();
  Report.result
    (let* successors = load set fleet settings path in
     set_binary_mode_in stdin true;
     set_binary_mode_out stdout true;
     match show_greeting, show_run with
     | true, true -> Error (Error.Bad_input "--greeting and --run exclude each other: give --greeting or --run")
     | true, false -> print_endline (Successor_service.greeting successors); Ok Exit_status.Done
     | false, true -> done_ (Successor_service.print_run successors stdin)
     | false, false -> done_ (Successor_service.serve successors stdin stdout))

let reduction =
  let kinds = [ ("none", Dolphin_explore.Reduction.Whole); ("por", Partial_order) ] in
  let doc =
    "The reduction of the state space: with $(b,none), all states; with $(b,por), only those reached by one order of \
     independent steps (partial order reduction). $(i,KIND) is one of these. With $(b,--invariant), as in $(mname) \
     $(b,explore), all orders are included."
  in
  Arg.(value & opt (enum kinds) Dolphin_explore.Reduction.Whole & info [ "reduction" ] ~docv:"KIND" ~doc)

let invariants =
  let doc = "Report for each state whether the condition $(docv) is false in it. May be repeated." in
  Arg.(value & opt_all string [] & info [ "invariant" ] ~docv:"CONDITION" ~doc)

let show_greeting =
  let doc = "Print the greeting alone, and read nothing." in
  Arg.(value & flag & info [ "greeting" ] ~doc)

let show_run =
  let doc =
    "Read one batch of states, a run from a successor of the initial state on, and print that run as $(mname) \
     $(b,explore) prints a counterexample. The initial state is not part of the batch."
  in
  Arg.(value & flag & info [ "run" ] ~doc)

let asked =
  let open Options.Syntax in
  let+ path = Options.program
  and+ set = Options.set
  and+ fleet = Options.fleet
  and+ answers = Explore_command.answers
  and+ faults = Explore_command.faults
  and+ reduction = reduction
  and+ invariants = invariants
  and+ show_greeting = show_greeting
  and+ show_run = show_run in
  { path; set; fleet; settings = { answers; faults; reduction; invariants }; show_greeting; show_run }

let man =
  [ `S Manpage.s_description;
    `P "$(tname) is for programs that search a state space themselves, on many machines for example \
        ($(i,docs/scale.md)): it reads batches of states from standard input, and writes their successors and \
        violations to standard output. It remembers no state. States are the same bytes in every process, so they can \
        be stored, compared and sent anywhere.";
    `P "It begins with a greeting, a line that names the version and has digests of the program and the fleet. Input \
        must begin with the same line, so that states of another program are rejected. $(i,docs/successors.md) \
        describes the protocol.";
    `S Manpage.s_examples;
    `Pre "  $(mname) $(tname) examples/rendezvous.dol --greeting" ]
  @ Options.see_also

let command =
  let info =
    Cmd.info "successors" ~docs:Options.s_others ~doc:"compute successors of states, for searches by other programs"
      ~man ~exits:(Options.exits [ Done; Bad_input; Inconclusive; Platform_trouble; Bug; Interrupted ])
  in
  Cmd.v info Term.(const run $ asked)
