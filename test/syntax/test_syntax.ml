let () =
  Alcotest.run "syntax"
    [ "parse", Test_parse.suite; "print", Test_print.suite; "least parentheses", Test_least.suite;
      "formatting", Test_formatting.suite; "depth", Test_depth.suite; "diagnostic", Test_diagnostic.suite ]
