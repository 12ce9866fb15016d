let () =
  Alcotest.run "maps"
    [ ("writing", Writing.cases); ("reading", Reading.cases); ("features", Wrong_features.cases);
      ("numerals", Numerals.cases);
      ("damage", Damage.cases); ("tiles", Tiles.cases) ]
