let cases required all =
  match required with
  | Ok x -> List.map (fun (name, run) -> Alcotest.test_case name `Quick (fun () -> run x)) all
  | Error why ->
    List.iter (fun (name, _) -> Printf.printf "skipped: %s: %s\n" name why) all;
    []
