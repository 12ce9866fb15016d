open Cmdliner
open Dolphin_app
module Safe_print = Dolphin_display.Safe_print

let ( let* ) = Result.bind

let is_program topic = Filename.extension topic <> "" || Sys.file_exists topic

let of_program path =
  Report.result
    (let* program = Program_file.load path in
     List.iter Safe_print.line (Program_help.lines program);
     Ok Exit_status.Done)

(* A pager would have the output, and the error if it cannot be written. *)
let form () = if Unix.isatty Unix.stdout then `Auto else `Plain

let run commands topic =
  match topic with
  | Some topic when is_program topic -> `Ok (of_program topic)
  | None -> `Help (form (), None)
  | Some topic when List.mem topic commands -> `Help (form (), Some topic)
  | Some topic ->
    let hint = Option.map (Printf.sprintf ": did you mean '%s'?") (Dolphin_syntax.Diagnostic.suggest topic commands) in
    Report.complain
      (Printf.sprintf "'%s' is neither a command nor a file%s" topic (Option.value hint ~default:""));
    `Ok Exit_status.Bad_input

let topic =
  let doc = "A program, a file such as $(i,mission.dol); or a command, whose manual is shown." in
  Arg.(value & pos 0 (some string) None & info [] ~docv:"PROG" ~doc)

let man =
  [ `S Manpage.s_description;
    `P "$(tname) prints how to use the program $(i,PROG): the comment at its beginning; its parameters, with their \
        values, which $(b,--set) of other commands replaces; the inputs that can be posted to it.";
    `S Manpage.s_examples;
    `Pre "  $(mname) $(tname) examples/parameters.dol\n  $(mname) exec examples/parameters.dol --set rounds=3\n\
         \  $(mname) $(tname) exec" ]
  @ Options.see_also

let command ~others =
  let info =
    Cmd.info "help" ~docs:Options.s_run ~doc:"show a program's parameters and inputs" ~man
      ~exits:(Options.exits [ Done; Bad_input; Bug ])
  in
  Cmd.v info Term.(ret (const (run ("help" :: others)) $ topic))
