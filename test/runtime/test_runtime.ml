let () =
  Alcotest.run "runtime"
    [ ("driver", Test_driver.tests); ("console", Test_console.tests); ("host", Test_host.tests);
      ("past", Test_history.tests); ("fences", Test_fences.suite);
      ("several platforms", Test_several.tests) ]
