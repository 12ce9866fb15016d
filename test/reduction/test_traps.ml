let () = Alcotest.run "traps" []
