let variable name = Option.bind (Sys.getenv_opt name) int_of_string_opt
let with_new usual = usual :: Option.to_list (variable "DOLPHIN_SEED")

let seeds ~usual = match variable "SEED" with Some seed -> [ seed ] | None -> with_new usual

let usual = ref true
let is_usual () = !usual
let count n = if is_usual () then incr n

(* The first seed is the usual one, or [SEED]. *)
let on_each seeds check =
  let one i seed =
    usual := i = 0;
    Fun.protect ~finally:(fun () -> usual := true) (fun () -> check seed)
  in
  List.iteri one seeds

let case ?(count = 100) name ~print generator property =
  let seeds = with_new 2018 in
  let cell = QCheck2.Test.make_cell ~count ~name ~print generator property in
  let check seed =
    if List.length seeds > 1 then Printf.printf "DOLPHIN_SEED=%d\n%!" seed;
    QCheck2.Test.check_cell_exn ~rand:(Random.State.make [| seed |]) cell
  in
  Alcotest.test_case name `Quick (fun () -> on_each seeds check)

let on_each_seed ~usual ~programs test =
  let compare seed =
    Printf.printf "SEED=%d PROGRAMS=%d\n%!" seed programs;
    QCheck2.Test.check_exn ~rand:(Random.State.make [| seed |]) test
  in
  on_each (seeds ~usual) compare
