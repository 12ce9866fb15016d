(* State spaces that can be counted by hand. Around what is executed, every program here has a state before its first
   [pick]; two for each pick (it waits, and the script goes on, or the next pick waits: see each); one after [execute];
   and the end. *)

open Dolphin_environment
open Dolphin_explore
open Test_support

let world n =
  let uuv i = Pure_run.vehicle (Printf.sprintf "n%d" (i + 1)) ~north:(float_of_int i) in
  Pure_run.world (List.init n uuv @ [ Pure_run.vehicle "x8" ~kind:"UAV" ])

let search ?(environment = Environment.default) ?(vehicles = 2) source =
  Search.run { Search.default with environment } (Pure_run.compile_exn source) (world vehicles)

let check name source ?environment ?vehicles ~states ~transitions () =
  let o = search ?environment ?vehicles source in
  Alcotest.(check int) (name ^ ", states") states o.states;
  Alcotest.(check int) (name ^ ", transitions") transitions o.transitions

(* message, end: start, after the message, ended. *)
let test_script () = check "script" "message 'a'" ~states:3 ~transitions:2 ()

(* The initial state picks (1), waits (2), is bound and executes (3); the task is ready (4), runs (5), is done: the
   script goes on (6) to the end (7). With failures one more end, and one more transition. *)
let one = "a = pick { id 'n1' }\nexecute task('p')[a]"
let test_one () = check "one task" one ~states:7 ~transitions:6 ()

let test_one_failing () =
  check "one task that may fail" one ~environment:(Environment.failing Environment.default) ~states:8 ~transitions:7 ()

(* Five states up to execute: initial, waiting, bound, waiting, bound. Each task is ready, runs or is done: 9 states, of
   which the one with both done is the script after execute; then the end: 5 + 9 + 1. Transitions: 5 up to the first of
   the nine; each of the 9 makes as many as there are tasks not done, 9 * 2 * 2/3 = 12; and 1. *)
let two = "a = pick { id 'n1' }\nb = pick { id 'n2' }\nexecute task('p')[a] | task('q')[b]"
let test_two () = check "two tasks" two ~states:15 ~transitions:18 ()

(* A failure ends all. Ends: either task's failure: 2. Transitions: each of the two fails where it runs and the other is
   in any of 3 states: 6 more. *)
let test_two_failing () =
  let environment = Environment.failing Environment.default in
  check "two tasks that may fail" two ~environment ~states:17 ~transitions:24 ()

(* At most one failure, which ends all here: the only difference is the bound. *)
let test_two_failing_once () =
  check "one failure at most" two
    ~environment:(Environment.failing ~failures:1 Environment.default)
    ~states:17 ~transitions:24 ()

(* Equal actions side by side are counted, not distinguished: 0, 1 or 2 of two actions left; the tuples follow.
   Initial, 2 left, 1 left, none left (the script goes on), end. Of 2 left either goes: 2 transitions to the same
   state. *)
let test_equal_actions () =
  let source = "def f() { action { post x:1 } }\nexecute f() | f()" in
  check "equal actions" source ~states:5 ~transitions:5 ()

(* One of three vehicles: initial, waiting, then 3 copies of (bound, ready, running, after, end); B is empty again at
   the end, but the variable has the vehicle. *)
let test_pick () =
  let source = "a = pick { type 'UUV' }\nexecute task('p')[a]" in
  check "choice of pick" source ~vehicles:3 ~states:(2 + (3 * 5)) ~transitions:(1 + 3 + (3 * 4)) ()

(* An interruption of each state but the end. The store alone distinguishes its successors: [a] has no value while
   its vehicle is picked, and one while its task is executed. *)
let test_interrupted () =
  let environment = { Environment.default with faults = { Faults.none with interrupt = true } } in
  check "one task, interrupted" one ~environment ~states:(7 + 2) ~transitions:(6 + 6) ()

(* Initial, called, replied; called again: 1 or 2; each called once more, of which it is known that it is not the first
   time: 0; the end. *)
let test_replies () =
  let source = "s = getSupplier()\nx = s.level\ny = s.level" in
  let environment = { Environment.default with replies = Calls.replies } in
  check "replies" source ~environment ~states:(3 + 1 + (2 * 4)) ~transitions:(2 + 1 + (2 * 4)) ()

(* N vehicles that survey, post ready:i and keep station, and one that meets each in any order, one at a time. For each
   i the vehicle has 6 states (survey ready, running; to post; station keeping ready, running; done); before the post,
   3, the meeting is not possible; after it, 3, it is to come or over: 9 together; or under way in 2 states: 6 more, for
   at most one i. So 9^N + N * 6 * 9^(N-1) = 9^(N-1) * (9 + 6 N), among them the state in which all is done, which is
   the script's; before there are initial, waiting, bound, waiting, bound, and after it the end: 6. *)
let fleet ?(around = Fun.id) n =
  let each format = List.init n (fun i -> Printf.sprintf format (i + 1)) in
  let meeting i = Printf.sprintf "when { consume ready:%d } then imcPlan('rv%d')" (i + 1) (i + 1) in
  let uuvs = String.concat " | " (each "u(%d)") and meetings = String.concat "\n" (List.init n meeting) in
  let task = Printf.sprintf "(%s)[us] | (allOf { %s })[ua]" uuvs meetings in
  Printf.sprintf
    "us = pick { count %d; type 'UUV' }\nua = pick { type 'UAV' }\n\
     def u(i) { imcPlan('survey' + i) >> action { post ready:i } >> imcPlan('sk' + i) }\nexecute %s"
    n (around task)

let rec power b n = if n = 0 then 1 else b * power b (n - 1)
let fleet_states n = (power 9 (n - 1) * (9 + (6 * n))) + 6

let test_fleet n () =
  let o = search ~vehicles:n (fleet n) in
  Alcotest.(check int) "states" (fleet_states n) o.states

(* A context around all of it, which never has a step, makes no more states. *)
let test_watched_fleet n () =
  let watched task = Printf.sprintf "(watch (%s) onError { ignore() })" task in
  let o = search ~vehicles:n (fleet ~around:watched n) in
  Alcotest.(check int) "states" (fleet_states n) o.states

(* The time may be over in each of them, when any of the posts has been made and not been taken: 2^N sets of tuples are
   left over where the script goes on, and where it ends. Without any, these are the states after tasks that were not
   cut. *)
let test_timed_fleet n () =
  let timed task = Printf.sprintf "(during 1.hours run (%s))" task in
  let o = search ~vehicles:n (fleet ~around:timed n) in
  Alcotest.(check int) "states" (fleet_states n + (2 * ((1 lsl n) - 1))) o.states

(* One more state, the action that follows, as the last of the others is done; it posts, and the script goes on. *)
let test_followed_fleet n () =
  let followed task = Printf.sprintf "(%s) >> action { post done:1 }" task in
  let o = search ~vehicles:n (fleet ~around:followed n) in
  Alcotest.(check int) "states" (fleet_states n + 1) o.states

(* Fields are wider than they need be only where no state takes more words for that. *)
let test_words () =
  let words ?spare_bits n =
    let tasks = String.concat " | " (List.init n (fun i -> Printf.sprintf "(idle(%d) >> idle(%d))" (i + 1) (i + 100))) in
    let program = Pure_run.compile_exn ("execute " ^ tasks) in
    let limits = { Dolphin_checker.Limits.none with max_states = Some 300 } in
    let graph = State_graph.create limits (Space.create ?spare_bits Environment.default program (world 1)) in
    State_graph.run graph;
    Space.words (State_graph.system graph)
  in
  let check n = Alcotest.(check int) (Printf.sprintf "words of %d components" n) (words ~spare_bits:0 n) (words n) in
  List.iter check (List.init 40 succ)

let () =
  let case name f = Alcotest.test_case name `Quick f in
  let fleets most test = List.init most (fun i -> case (Printf.sprintf "of %d" (i + 1)) (test (i + 1))) in
  Alcotest.run "counts"
    [
      ( "by hand",
        [
          case "a script" test_script;
          case "a task" test_one;
          case "a task that may fail" test_one_failing;
          case "two tasks side by side" test_two;
          case "two tasks that may fail" test_two_failing;
          case "failures are bounded" test_two_failing_once;
          case "equal actions" test_equal_actions;
          case "a pick has choices" test_pick;
          case "a task that may be interrupted" test_interrupted;
          case "replies of a supplier" test_replies;
          case "words of states" test_words;
        ] );
      ("fleets", fleets 5 test_fleet);
      ("fleets under watch", fleets 5 test_watched_fleet);
      ("fleets for a time", fleets 5 test_timed_fleet);
      ("fleets that an action follows", fleets 5 test_followed_fleet);
    ]
