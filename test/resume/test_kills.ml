let sample ?is_losing n () =
  match Resume_test.Kills.run ?is_losing (Some n) with Ok _ -> () | Error summary -> Alcotest.fail summary

let () =
  Alcotest.run "kills"
    [ ( "kills",
        [ Alcotest.test_case "a console killed at 20 points" `Quick (sample 20);
          Alcotest.test_case "a console killed after 30 lines, whose journal loses its end" `Quick
            (sample ~is_losing:true 30) ] ) ]
