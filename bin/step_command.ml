open Cmdliner
open Dolphin_conformance

(* No request is longer. *)
let longest = 64 * 1024 * 1024

type line = Line of string | Too_long | End

let rec skip_line channel =
  match input_char channel with '\n' -> () | _ -> skip_line channel | exception End_of_file -> ()

let read_line channel =
  let line = Buffer.create 1024 in
  let rec go () =
    match input_char channel with
    | '\n' -> Line (Buffer.contents line)
    | exception End_of_file -> if Buffer.length line = 0 then End else Line (Buffer.contents line)
    | _ when Buffer.length line >= longest -> skip_line channel; Too_long
    | c -> Buffer.add_char line c; go ()
  in
  go ()

let too_long = {|{"error":{"code":"bad-request","message":"a request is at most 64 MB long"}}|}
let is_blank line = String.trim line = ""

let run () =
  set_binary_mode_in stdin true;
  let reply text =
    print_string text;
    print_char '\n';
    flush stdout
  in
  let rec go oracle =
    match read_line stdin with
    | End -> Exit_status.Done
    | Too_long -> reply too_long; go oracle
    | Line line when is_blank line -> go oracle
    | Line line ->
      let oracle, answer = Oracle.answer_line oracle line in
      reply answer;
      go oracle
  in
  go (Oracle.start ~name:("dolphin " ^ Version.number))

let man =
  [ `S Manpage.s_description;
    `P "$(tname) answers questions about the semantics on its standard input, in lines of JSON: a program and a fleet \
        in, where its runs begin out; a configuration in, all its transitions out, each with its rules, label, effects \
        and next configuration. A configuration can be kept, compared, and asked about at any time: nothing is \
        remembered but the program that was given last.";
    `P "So another implementation can be held against this one, and tools can walk through a program's runs without \
        OCaml. $(i,conformance/INTERPRETING.md) describes the protocol; $(mname) $(b,conform) speaks it to others.";
    `S Manpage.s_examples;
    `Pre "  \\$ $(mname) $(tname)\n\
         \  {\"request\":\"initial\",\"program\":\"post a: 1\",\"fleet\":\"\"}\n\
         \  {\"configuration\":{\"control\":\"script\",\"end\":null,\"A\":{},\"B\":[],\"N\":[],...},\"world\":[]}\n\
         \  {\"request\":\"step\",\"configuration\":...}\n\
         \  {\"transitions\":[{\"rule\":[\"POST\"],\"label\":\"post a:1\",...,\"next\":...}],\"awaited\":...}" ]
  @ Options.see_also

let command =
  let info =
    Cmd.info "step" ~doc:"tell what a configuration can do, for other programs" ~man
      ~exits:(Options.exits [ Done; Platform_trouble; Bug ])
  in
  Cmd.v info Term.(const run $ const ())
