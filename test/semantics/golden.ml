open Dolphin_semantics
open Test_support

let read file =
  let channel = open_in_bin file in
  let text = really_input_string channel (in_channel_length channel) in
  close_in channel;
  text

let cases text =
  let case text =
    match String.index_opt text '\n' with
    | Some i -> (String.sub text 0 i, String.sub text (i + 1) (String.length text - i - 1))
    | None -> (text, "")
  in
  List.map case (Str.split (Str.regexp "^==== ") text)

let faults source =
  match Dolphin_syntax.Parse.program ~file:"test.dol" source with
  | Error faults -> faults
  | Ok ast -> (
      match Elaborate.program ~source_name:"test.dol" ast with
      | Error faults -> faults
      | Ok (_, warnings) -> warnings)

let ran source =
  let program = Pure_run.compile_exn source in
  let run = Pure_run.run ~limit:1_000 ~answers:[ "2" ] program in
  let place =
    match Pure_run.last run with
    | Some { control = Ended (Failed fault); _ } -> (
        match Fault.location program fault with
        | Some at -> Format.asprintf "%a: " Dolphin_syntax.Location.pp at
        | None -> "nowhere: ")
    | _ -> ""
  in
  List.map (fun text -> "  " ^ text) (Pure_run.said run) @ [ place ^ Pure_run.ending run ]

let () =
  let print (title, source) =
    Printf.printf "==== %s\n" title;
    match faults source with
    | [] -> List.iter print_endline (ran source)
    | faults -> print_endline (Pure_run.explain source faults)
  in
  List.iter print (cases (read Sys.argv.(1)))
