let () = Alcotest.run "sim_imc" [ "as a real vehicle", Test_recording.tests ]
