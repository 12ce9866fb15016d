let () =
  Alcotest.run "platform_imc"
    [ Test_lifecycle.tests; Test_fleet.tests; Test_execution.tests; Test_readiness.tests; Test_positions.tests;
      Test_claims.tests; Test_holds.tests; Test_adoption.tests; Test_lingering.tests; Test_crowd.tests; Test_door.tests;
      Test_consoles.tests; Test_interventions.tests;
      Test_hostile.tests; Test_extremes.tests; Test_network.tests; Test_interfaces.tests; Test_imcpy.tests ]
