(* Progress in a log: a line every ten seconds, however often a search reports. *)

open Dolphin_app

let at elapsed : Dolphin_checker.Limits.progress =
  { phase = "exploring"; states = 1_200; rate = 100.; frontier = 40; depth = 7; memory = 3 * 1024 * 1024; elapsed }

let printed times =
  let lines = ref [] in
  let report = Progress_lines.every 10. (fun line -> lines := line :: !lines) in
  List.iter (fun elapsed -> report (at elapsed)) times;
  List.rev !lines

let line elapsed = Progress_lines.line (at elapsed)

let test_periods () =
  let check name expected times = Alcotest.(check (list string)) name (List.map line expected) (printed times) in
  check "none in the first ten seconds" [] [ 1.; 5.; 9.9 ];
  check "one for each ten" [ 10.; 20.5; 30. ] [ 1.; 9.; 10.; 11.; 20.5; 29.; 30.; 31. ];
  check "those that nothing is reported in are left out" [ 35.; 40. ] [ 35.; 36.; 40. ]

let test_line () =
  Alcotest.(check string) "a line" "exploring: 1200 states, 100/s, frontier 40, depth 7, 3 MiB, 12 s" (line 12.);
  Alcotest.(check string) "of what has no states" "slack, 3 of 20: 3 MiB, 12 s"
    (Progress_lines.line { (at 12.) with phase = "slack, 3 of 20"; states = 0 })

let () =
  let case name f = Alcotest.test_case name `Quick f in
  Alcotest.run "progress" [ ("in a log", [ case "periods" test_periods; case "words" test_line ]) ]
