let case ?(count = 100) name ~print generator property =
  let cell = QCheck2.Test.make_cell ~count ~name ~print generator property in
  Alcotest.test_case name `Quick (fun () ->
      QCheck2.Test.check_cell_exn ~rand:(Random.State.make [| 2018 |]) cell)
