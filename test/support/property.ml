let seeds = 2018 :: Option.to_list (Option.bind (Sys.getenv_opt "DOLPHIN_SEED") int_of_string_opt)

let case ?(count = 100) name ~print generator property =
  let cell = QCheck2.Test.make_cell ~count ~name ~print generator property in
  let check seed =
    if List.length seeds > 1 then Printf.printf "DOLPHIN_SEED=%d\n%!" seed;
    QCheck2.Test.check_cell_exn ~rand:(Random.State.make [| seed |]) cell
  in
  Alcotest.test_case name `Quick (fun () -> List.iter check seeds)
