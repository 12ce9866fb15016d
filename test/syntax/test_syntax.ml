let () = Alcotest.run "syntax" [ "print", Test_print.suite ]
