let () =
  Alcotest.run "imc"
    [
      ("values", Test_values.suite);
      ("definition", Test_definition.suite);
      ("corpus", Test_corpus.suite);
      ("random", Test_random.suite);
      ("hostile", Test_hostile.suite);
      ("imcpy", Test_imcpy.suite);
    ]
