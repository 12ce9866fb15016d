let sample () = match Resume_test.Kills.run (Some 20) with Ok _ -> () | Error summary -> Alcotest.fail summary
let () = Alcotest.run "kills" [ ("kills", [ Alcotest.test_case "a console killed at 20 points" `Quick sample ]) ]
