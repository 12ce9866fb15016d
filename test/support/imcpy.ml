let cases all =
  match Sys.getenv_opt "DOLPHIN_IMCPY" with
  | None | Some "" ->
    List.iter (fun (name, _) -> Printf.printf "skipped: %s: no imcpy, DOLPHIN_IMCPY is not set\n" name) all;
    []
  | Some python -> List.map (fun (name, run) -> Alcotest.test_case name `Quick (fun () -> run ~python)) all
