open Cmdliner
open Dolphin_app
module Safe_print = Dolphin_display.Safe_print

let ( let* ) = Result.bind
let trouble result = Result.map_error (fun why -> Error.Bad_input why) result

let rec each f = function
  | [] -> Ok ()
  | x :: rest ->
    let* () = f x in
    each f rest

let post connection words =
  let* pairs = trouble (Typed_input.read (String.concat " " words)) in
  each (fun (key, x) -> trouble (Result.map ignore (Run_socket.post connection key x))) pairs

let status connection =
  let* { Socket_message.program; time; inputs; questions } = trouble (Run_socket.status connection) in
  Safe_print.printf "%s, at %s\n" program (Dolphin_trace.Phrase.time time);
  if inputs = [] && questions = [] then Safe_print.line "nothing can be posted: the program declares no input";
  List.iter (fun key -> Safe_print.line ("input '" ^ key ^ "'")) inputs;
  List.iter (fun prompt -> Safe_print.line ("question '" ^ prompt ^ "': yes or no")) questions;
  Ok ()

let follow connection =
  let* _ = trouble (Run_socket.ask connection Follow) in
  Run_socket.copy connection stdout;
  Ok ()

let stop connection = trouble (Result.map ignore (Run_socket.ask connection Stop))

let run () name words ~what =
  Report.result
    (let* journal = Run_folder.journal name in
     let* connection = trouble (Run_socket.connect ~journal) in
     let* () =
       match what, words with
       | `Post, [] -> status connection
       | `Post, words -> post connection words
       | `Follow, [] -> follow connection
       | `Stop, [] -> stop connection
       | (`Follow | `Stop), _ :: _ -> Error (Error.Bad_input "--follow and --stop go with no pairs")
     in
     Ok Exit_status.Done)

let run_name =
  let doc = "The run: its name or a prefix of it, $(b,latest), or the path of its journal." in
  Arg.(required & pos 0 (some string) None & info [] ~docv:"RUN" ~doc)

let words =
  let doc =
    "The pairs, a key and a value each, separated by commas: $(b,abort: true). A key alone stands for $(b,true). \
     Texts stand in quotes, which the shell must leave there: $(b,\"target: 'north'\")."
  in
  Arg.(value & pos_right 0 string [] & info [] ~docv:"KEY: VALUE" ~doc)

let what =
  let follow = (`Follow, Arg.info [ "follow" ] ~doc:"Print the journal of the run, until it ends.") in
  let stop = (`Stop, Arg.info [ "stop" ] ~doc:"Stop the run, as Ctrl-C does.") in
  Arg.(value & vflag `Post [ follow; stop ])

let command =
  let man =
    [ `S Manpage.s_description;
      `P "$(tname) posts pairs to a run in progress, with keys that its program declares by $(b,input). It returns \
          when the run has taken them. Without pairs it prints the program's declarations.";
      `P "It speaks to the socket beside the journal of the run, as other programs may: $(i,docs/socket.md). Runs on \
          vehicles of a network have one, and simulated ones with $(b,--speed) and a journal.";
      `S Manpage.s_examples;
      `Pre "  $(mname) exec mission.dol --speed 1 --keep\n  $(mname) $(tname) latest abort: true" ]
    @ Options.see_also
  in
  let info =
    Cmd.info "post" ~docs:Options.s_run ~doc:"post to a run in progress, follow it or stop it" ~man
      ~exits:(Options.exits [ Done; Bad_input; Platform_trouble; Bug ])
  in
  let run setup name words what = run setup name words ~what in
  Cmd.v info Term.(const run $ Verbosity.setup $ run_name $ words $ what)
