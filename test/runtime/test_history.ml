open Dolphin_semantics
open Dolphin_runtime

let case name test = Alcotest.test_case name `Quick test
let task name : Core.platform_task = { name; plan = None; task_site = 0 }
let at time what : History.entry = { time; what }
let asked time effects = at time (Asked { number = int_of_float time; effects })
let note text : Yojson.Safe.t = `String text

let look_for timeout : Effect.t =
  let filter : Settings.filter = { id = None; kind = None; payload = []; region = None } in
  Look_for { filter; count = Exactly 1; timeout; otherwise = false }

let outstanding = History.outstanding ~announce_period:10.
let names tasks = List.map (fun (v, (e : History.commanded)) -> (v, e.task.name)) tasks
let name_of = Option.map (fun (e : History.commanded) -> e.task.name)

let vehicles_and_tasks () =
  let s =
    outstanding
      [ asked 0. [ Bind [ "a"; "b" ] ];
        asked 1. [ Start ("a", task "p"); Start ("b", task "p") ];
        at 2. (Noted ("a", note "first"));
        at 3. (Noted ("a", note "second"));
        at 4. (Happened (Vehicle_done "b"));
        asked 5. [ Stop "a"; Release [ "b" ] ] ]
  in
  Alcotest.(check (list string)) "bound" [ "a" ] s.bound;
  Alcotest.(check (list (pair string string))) "under way" [ ("a", "p") ] (names s.tasks);
  let a = List.assoc "a" s.tasks in
  Alcotest.(check bool) "told to stop" true a.is_stopped;
  Alcotest.(check int) "by the transition of this number" 1 a.number;
  Alcotest.(check (list string)) "notes, latest first" [ "second"; "first" ]
    (List.map Yojson.Safe.Util.to_string a.notes)

(* Of the tasks before, only the last may still have to be stopped. *)
let one_task_after_another () =
  let start name : Effect.t = Start ("a", task name) in
  let s = outstanding [ asked 1. [ start "p" ]; asked 2. [ Stop "a"; start "q" ]; asked 3. [ Stop "a"; start "r" ] ] in
  let r = List.assoc "a" s.tasks in
  Alcotest.(check string) "the last" "r" r.task.name;
  Alcotest.(check bool) "not stopped" false r.is_stopped;
  Alcotest.(check (option string)) "the one before" (Some "q") (name_of r.before);
  Alcotest.(check (option string)) "and no other" None (name_of (Option.bind r.before (fun q -> q.before)))

let timers () =
  let ring timeout = (outstanding [ asked 5. [ look_for timeout ] ]).timers in
  let timers = Alcotest.(list (pair int (float 0.))) in
  Alcotest.check timers "as long as the pick says" [ (Residual.script_timer, 7.) ] (ring (Some 2.));
  Alcotest.check timers "or an announce period" [ (Residual.script_timer, 15.) ] (ring None);
  let set timer seconds : Effect.t = Set_timer (timer, seconds) in
  let s =
    outstanding
      [ asked 0. [ set 1 10.; set 2 20.; set 3 infinity; set 4 (-1.) ];
        at 4. (Happened (Timer_expired 4)); asked 5. [ Cancel_timer 1 ]; asked 6. [ set 2 30. ] ]
  in
  Alcotest.check timers "what is left, from when it was set" [ (2, 36.) ] s.timers

let timeouts () =
  let single : Effect.t = Set_connection_timeout (Some [ "a" ], 30.) in
  let all : Effect.t = Set_connection_timeout (None, 90.) in
  let check name (timeout, timeouts) history =
    let s = outstanding history in
    Alcotest.(check (option (float 0.))) name timeout s.timeout;
    Alcotest.(check (list (pair string (float 0.)))) name timeouts s.timeouts
  in
  check "nobody set one" (None, []) [];
  check "one for all, then one of its own" (Some 90., [ ("a", 30.) ]) [ asked 1. [ all ]; asked 2. [ single ] ];
  check "one for all is for all" (Some 90., []) [ asked 1. [ single ]; asked 2. [ all ] ]

let answered text : Transition.event =
  let program = Test_support.Pure_run.compile_exn "here = 1" in
  Result.get_ok (Answer.event program text)

let answers () =
  let found =
    History.answers
      [ asked 1. [ Ask "How many?" ]; at 2. (Happened (answered "2")); asked 3. [ Ask "Where?" ];
        at 4. (Happened (answered "here")); asked 5. [ Ask "When?" ];
        at 6. (Happened (Nobody_answers "none is given")) ]
  in
  Alcotest.(check (list (pair string string))) "in order" [ ("How many?", "2"); ("Where?", "here") ] found

let tests =
  [ case "vehicles and their tasks" vehicles_and_tasks;
    case "of one task after another, the last two" one_task_after_another;
    case "timers" timers;
    case "connection timeouts" timeouts;
    case "answers" answers ]
