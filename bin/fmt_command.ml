open Cmdliner
open Dolphin_app
module Safe_print = Dolphin_display.Safe_print

let ( let* ) = Result.bind
let standard_input = "standard input"

(* Whether the text was in the layout before. *)
let format_input check =
  set_binary_mode_in stdin true;
  let* source = Text_file.read_input () in
  let* text = Source_file.formatted ~file:standard_input source in
  if not check then print_string text
  else if text <> source then Safe_print.printf "%s\n" standard_input;
  Ok (text = source)

let format_file check path =
  let* source = Text_file.read path in
  let* text = Source_file.formatted ~file:path source in
  if text = source then Ok true
  else begin
    let* () = if check then Ok () else Source_file.replace path text in
    Safe_print.line path;
    Ok false
  end

(* The worst of their outcomes: each is tried. *)
let each check paths =
  let one worst path =
    let status =
      match if path = "-" then format_input check else format_file check path with
      | Ok same -> if same || not check then Exit_status.Done else Failed
      | Error e -> Report.error e in
    if Exit_status.code status > Exit_status.code worst then status else worst
  in
  List.fold_left one Exit_status.Done paths

let run check paths =
  match Source_file.all (if paths = [] then [ "-" ] else paths) with
  | Error e -> Report.error e
  | Ok paths -> each check paths

let paths =
  let doc =
    "Programs and fleets, and folders of them. Without any, or for $(b,-), standard input is formatted onto standard \
     output." in
  Arg.(value & pos_all string [] & info [] ~docv:"FILE" ~doc)

let check =
  let doc = "Change nothing; name the files that would be changed, and end with status 1 if there are any." in
  Arg.(value & flag & info [ "check" ] ~doc)

let man =
  [ `S Manpage.s_description;
    `P "$(tname) formats programs and fleets in one way: four spaces a level, one blank between words, a statement a \
        line, at most 120 columns. It rewrites each $(i,FILE) that has another layout, and prints its name.";
    `P "Comments stay, and so do ends of lines between arguments and before operators; of several empty lines one \
        stays. Braces are on one line as a whole, or have a line for each statement. Only comments and strings may go \
        beyond 120 columns. The program means the same, and formatting it again changes nothing.";
    `P "A file with errors is left as it is.";
    `S Manpage.s_examples;
    `Pre "  $(mname) $(tname) mission.dol\n  $(mname) $(tname) --check .\n  $(mname) $(tname) < mission.dol" ]
  @ Options.see_also

let exits =
  Cmd.Exit.info (Exit_status.code Failed) ~doc:"with $(b,--check): a file has another layout."
  :: Options.exits [ Done; Bad_input; Platform_trouble; Bug ]

let command =
  let info =
    Cmd.info "fmt" ~docs:Options.s_write ~doc:"format programs and fleets in one way" ~man ~exits in
  Cmd.v info Term.(const run $ check $ paths)
