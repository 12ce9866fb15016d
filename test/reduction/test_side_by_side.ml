(* On random programs, the plans that run side by side are those of the plain search, in a search that first asks, with
   partial order, which plans there are, and that exchanges vehicles. PROGRAMS in the environment is how many programs
   are tried, 1,000 by default. *)

open Dolphin_plans
open Dolphin_semantics
open Dolphin_environment
open Dolphin_explore
module Generate = Test_support.Generate
module Calls = Test_support.Calls
module Posts = Test_support.Posts

let programs = match Sys.getenv_opt "PROGRAMS" with Some n -> int_of_string n | None -> 1_000
let usual = 20_261_123
let limits = { Dolphin_checker.Limits.none with max_states = Some 3_000 }

let distance : Fences.fence =
  { rule = Distance 10.; margin = 0.; text = "fence distance 10.m"; at = Dolphin_syntax.Location.none }

let answering = { Environment.default with answers = (fun _ -> [ [ "1"; "null" ] ]); replies = Calls.replies }

let environments =
  [ ("as planned", answering);
    ("with failures", Environment.failing answering);
    ("with a failure", Environment.failing ~failures:1 answering);
    ("with losses", { answering with faults = { Faults.none with loss = Any_number } });
    ("with latecomers", { answering with faults = { Faults.none with join = Any_number } });
    ("with inputs", { answering with inputs = Posts.inputs });
    ("with interruptions", { answering with faults = { Faults.none with interrupt = true } }) ]

let case =
  let open QCheck2.Gen in
  let program = frequency [ (2, Generate.program); (1, Generate.replicated); (1, Calls.within Generate.program) ] in
  pair program (oneofl environments)

let print (program, (name, _)) = Printf.sprintf "%s:\n%s" name (Generate.print program)

(* Vehicles may have changed places. The destinations of these plans are unknown, so all pairs are reported. *)
let names (pairs : Side_by_side.pair list) =
  let key ((_, p) : _ * Core.platform_task) = (p.task_site, p.name) in
  let pair (p : Side_by_side.pair) = List.sort compare [ key p.one; key p.other ] in
  List.sort_uniq compare (List.map pair pairs)

let skipped = ref 0 and told = ref 0

let agrees (ast, (_, environment)) =
  let program = { (Posts.declared environment (Generate.compile ast)) with fences = Fences.make [ distance ] } in
  let find reduction =
    Search.side_by_side { Search.default with environment; reduction; limits } program Generate.world in
  match find Whole with
  | _, Some _ -> incr skipped; true
  | expected, None ->
    told := !told + List.length expected;
    let agrees reduction =
      let found, stopped = find reduction in
      stopped = None && names found = names expected
    in
    agrees All && agrees Partial_order

let test_agreement () =
  let test = QCheck2.Test.make ~count:programs ~print ~name:"both searches find the same pairs" case agrees in
  Test_support.Property.on_each_seed ~usual ~programs test;
  Printf.printf "%d pairs, %d programs skipped\n" !told !skipped;
  Alcotest.(check bool) "some plans run side by side" true (!told > 0)

(* Both searches use the same code for their observations. *)
let test_three () =
  let task name : Core.platform_task = { name; plan = None; task_site = 0 } in
  let seen = Side_by_side.create (Fences.make [ distance ]) in
  let add running (v, name) = Vehicle_map.add v (task name) running in
  let running = List.fold_left add Vehicle_map.empty [ ("a", "p"); ("b", "q"); ("c", "r") ] in
  Side_by_side.see seen running;
  let both (p : Side_by_side.pair) = (Side_by_side.name (snd p.one), Side_by_side.name (snd p.other)) in
  Alcotest.(check (list (pair string string)))
    "each pair once" [ ("'p'", "'q'"); ("'p'", "'r'"); ("'q'", "'r'") ]
    (List.sort compare (List.map both (Side_by_side.pairs seen)));
  Alcotest.(check int) "each plan might also run twice" 6 (Side_by_side.candidates seen)

(* Partial order alone would follow one plan of the one vehicle beside those of the other. *)
let test_orders () =
  let program =
    Test_support.Pure_run.compile_exn
      "vs = pick { count 2 }\nexecute (task('p') >> task('q'))[vs[0]] | (task('r') >> task('s'))[vs[1]]\n"
  in
  let program = { program with fences = Fences.make [ distance ] } in
  let expected = [ [ "p"; "r" ]; [ "p"; "s" ]; [ "q"; "r" ]; [ "q"; "s" ] ] in
  let check reduction =
    let options = { Search.default with environment = answering; reduction; limits } in
    let found, stopped = Search.side_by_side options program Generate.world in
    Alcotest.(check bool) "all states were seen" true (stopped = None);
    Alcotest.(check (list (list string))) "pairs" expected (List.map (List.map snd) (names found))
  in
  List.iter check [ Reduction.Whole; Partial_order; All ]

let () =
  Alcotest.run "side by side"
    [ ("states", [ Alcotest.test_case "three plans have three pairs" `Quick test_three;
                   Alcotest.test_case "plans in any order" `Quick test_orders ]);
      ("random programs", [ Alcotest.test_case "both searches find the same pairs" `Quick test_agreement ]) ]
