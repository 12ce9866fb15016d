open Test_support
let () =
  let file = Sys.argv.(1) in
  let ic = open_in_bin file in
  let source = really_input_string ic (in_channel_length ic) in
  match Pure_run.compile source with
  | Error ds -> print_endline (Pure_run.explain source ds)
  | Ok p -> List.iter print_endline (Pure_run.labels (Pure_run.run ~answers:["2"] p))
