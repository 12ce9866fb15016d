(* Counterexamples of random programs, with their assumptions about the world, are written, read, and followed to
   their ends; files that do not fit are refused. *)

open Dolphin_environment
open Dolphin_checker
open Dolphin_explore
module Generate = Test_support.Generate
module Witness = Dolphin_trace.Witness
module Configuration = Dolphin_semantics.Configuration
module Transition = Dolphin_semantics.Transition

let source path : Dolphin_trace.Header.source = Dolphin_trace.Header.source ~path ""

let course_of program world property (run : Search.run) : Witness.t =
  let initial = Configuration.initial program in
  let after = List.fold_left (fun _ (t : Transition.t) -> t.next) initial run.steps in
  let steps = Witness.steps program world in
  { program = source "random.dol"; fleet = None; property = Property.name property; steps = steps initial run.steps;
    cycle = steps after run.cycle }

let same ts ts' =
  List.compare_lengths ts ts' = 0
  && List.for_all2 (fun (t : Transition.t) (t' : Transition.t) -> Configuration.equal t.next t'.next) ts ts'

let comes_back program world (property, (run : Search.run)) =
  let course = course_of program world property run in
  match Witness.of_lines (Witness.to_lines course) with
  | Error why -> QCheck2.Test.fail_reportf "not read: %s" why
  | Ok read -> (
      read = course
      &&
      match Witness.follow program world read with
      | Ok (steps, cycle) -> same steps run.steps && same cycle run.cycle
      | Error (_, { number; why }) -> QCheck2.Test.fail_reportf "step %d: %s" number why)

let follows ((ast, world), answers) =
  let program = Generate.compile ast in
  let environment =
    { Environment.default with
      answers = (fun _ -> answers);
      replies = Test_support.Calls.replies;
      may_be_late = (fun v -> v = "b");
      faults = { fail = Any_number; loss = Any_number; join = Any_number; interrupt = true } }
  in
  let options = { Search.default with environment; limits = { Limits.none with max_states = Some 2_000 } } in
  let o = Search.run options program world in
  let violation (property, verdict) =
    match (verdict : Search.verdict) with
    | Violated run -> Some (property, run)
    | Holds | Holds_if _ | By_design _ | Unreached _ | Inconclusive _ -> None
  in
  List.for_all (comes_back program world) (List.filter_map violation o.verdicts)

let case =
  let open QCheck2.Gen in
  let closed = map (fun p -> (p, Generate.world)) Generate.program in
  let opened = map (fun p -> (p, Generate.open_world)) Generate.sensing_program in
  let calling = map (fun p -> (p, Generate.world)) (Test_support.Calls.within Generate.program) in
  pair (oneof [ closed; opened; calling ])
    (oneofl [ []; [ [ "1"; "2" ] ]; [ [ "nonsense(" ] ]; [ [ "nonsense(" ]; [ "2" ] ] ])

(* {1 What does not fit} *)

let header =
  {|{"format":"dolphin-course","version":1,"program":{"path":"p","md5":""},"fleet":null,|}
  ^ {|"property":"x","steps":1,"cycle":0}|}

let refused =
  [ ([], "this is not a run to follow: it is empty"); ([ "{" ], "line 1 is not JSON");
    ([ "[]" ], "this is not a run to follow: its first line is not the header of one");
    ([ {|{"format":"dolphin-course","version":9}|} ], "this run is of version 9; version 1 is known here");
    ([ header ], "1 steps are announced, and 0 are there"); ([ header; "{}" ], {|line 2: "label" is missing|});
    ([ header; {|{"label":"end","choice":-1}|} ], "line 2: a choice is a number from 0");
    ([ header; {|{"label":"end","choice":0,"assumed":[{"wind":"a"}]}|} ],
     "line 2: unknown assumption: expected late, missing, battery, speed, connected, progress, reading, position or claim");
    ([ header; {|{"label":"end","choice":0,"assumed":[{"battery":"a"}]}|} ], {|line 2: "is" is missing|});
    ([ header; {|{"label":"end","choice":0,"assumed":[{"position":"a","is":[91,0,0]}]}|} ],
     "line 2: latitude 91 is not from -90 to 90 degrees");
    ([ header; {|{"label":"end","event":"rain"}|} ],
     {|line 2: "event" is 'rain', not one of done, failed, timer, confirmation, no-confirmation, recruited, answer, |}
     ^ "no-answer, reply, no-reply, input, interruption") ]

let refused_case (lines, expected) =
  let check () =
    match Witness.of_lines lines with
    | Ok _ -> Alcotest.fail "it is read"
    | Error why -> Alcotest.(check string) "why" expected why
  in
  Alcotest.test_case expected `Quick check

let () =
  Alcotest.run "course"
    [ ( "random programs",
        [ Test_support.Property.case "runs are followed" ~count:500 case follows
            ~print:(fun ((p, _), _) -> Generate.print p) ] );
      ("refused", List.map refused_case refused) ]
