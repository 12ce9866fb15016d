(* Not part of the tests, as it takes some minutes: dune exec test/resume/kill_everywhere.exe *)

let () =
  match Resume_test.Kills.run None with
  | Ok summary -> print_endline summary
  | Error summary -> print_endline summary; exit 1
