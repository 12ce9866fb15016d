let () =
  Alcotest.run "sim_imc"
    [ "as a real vehicle", Test_recording.tests; "as four real vehicles", Test_recorded_fleet.tests; "contact", Test_contact.tests; "plans", Test_plans.tests;
      "faults", Test_faults.tests; "network", Test_network.tests ]
