(* What is found by several processes is what is found by one, on random programs and on the examples, with and without
   bounds; and how they end. PROGRAMS in the environment is how many programs are tried, 120 by default. *)

open Dolphin_semantics
open Dolphin_time
module Limits = Dolphin_checker.Limits
module Scenario = Dolphin_scenario.Scenario
module Scenario_world = Dolphin_environment.Scenario_world
module Examples = Test_support.Examples

let programs = match Sys.getenv_opt "PROGRAMS" with Some n -> int_of_string n | None -> 120

(* {1 The same} *)

(* All that is found, as plain data. *)
let said (o : Timing.outcome) =
  let labels = List.map (fun (t : Transition.t) -> (Format.asprintf "%a" Label.pp t.label, t.rules, t.assumed)) in
  let link (l : Schedule.link) = (l.pending.item, l.from, l.until, l.lasts) in
  let run (r : Timing.run) = (labels r.steps, r.dates, r.turns, labels r.cycle, List.map link r.chain) in
  let missed (site, missed) = (site, Option.map (fun (window, r) -> (window, run r)) missed) in
  let battery (b : Timing.battery) = (b.vehicle, b.least, Option.map (fun (left, r) -> (left, run r)) b.lowest) in
  let runs = List.map (Option.map run) [ o.last; o.first; o.late; o.failing ] in
  ( (o.endings, o.tasks, List.map missed o.deadlines, List.map battery o.batteries),
    (runs, Option.map (fun (r, why) -> (run r, why)) o.endless),
    (List.map (fun (p : Timed.pending) -> p.item) o.unknown, o.stopped, o.reduction, o.states, o.depth) )

let same_end (o : Timing.outcome) (o' : Timing.outcome) =
  let last_step (r : Timing.run) = List.nth r.steps (List.length r.steps - 1) in
  let last (o : Timing.outcome) = Option.map last_step o.first in
  match last o, last o' with
  | Some t, Some t' -> Configuration.equal t.next t'.next
  | None, None -> true
  | Some _, None | None, Some _ -> false

let no_child () =
  match Unix.waitpid [ WNOHANG ] (-1) with _ -> false | exception Unix.Unix_error (ECHILD, _, _) -> true

let bounded = ref 0 and compared = ref 0 and less_reduced = ref 0

(* By two, from the first state on. *)
let is_same ?vehicles limits options =
  let run workers = Timing.run ?vehicles ~workers ~fork_from:1 limits options in
  let one = run 1 and two = run 2 in
  incr compared;
  if one.stopped <> None then incr bounded;
  if one.reduction <> Inert_ends_and_likeness then incr less_reduced;
  said one = said two && same_end one two && no_child ()

let same_slacks options =
  let limits = { Limits.none with max_states = Some 300 } in
  let o = Timing.run limits options in
  let slacks workers = Timing.slacks ~workers ~fork_from:1 limits options o in
  o.states > 60 || (slacks 1 = slacks 3 && no_child ())

let agrees (case, most) =
  let options = Random_missions.options case and vehicles = Random_missions.batteries in
  let limits = { Limits.none with max_states = Some 1_000 } in
  (is_same ~vehicles limits options || QCheck2.Test.fail_report "something else is found")
  && (is_same ~vehicles { limits with max_states = Some most } options
      || QCheck2.Test.fail_report "something else is found within fewer states")
  && (is_same { limits with max_depth = Some most } options
      || QCheck2.Test.fail_report "something else is found within less depth")
  && (same_slacks options || QCheck2.Test.fail_report "other slacks")

let test_random () =
  let case = QCheck2.Gen.(pair Random_missions.case (int_range 1 40)) in
  let print (case, most) = Printf.sprintf "within %d: %s" most (Random_missions.print case) in
  let test = QCheck2.Test.make ~count:programs ~print ~name:"workers make no difference" case agrees in
  Test_support.Property.on_each_seed ~usual:20_261_127 ~programs test;
  Printf.printf "%d comparisons, %d with a bound that was met, %d with less reduction\n" !compared !bounded !less_reduced;
  Alcotest.(check bool) "variety" true (!bounded * 5 > programs && !less_reduced * 20 > programs)

let options program scenario : Timed.options =
  { environment = Scenario_world.environment ~answers:[] ~faults:Dolphin_environment.Faults.none program scenario;
    program; world = Scenario_world.world scenario; durations = Durations.of_scenario scenario;
    dates = Dated_code.named program }

let read_example name =
  let path = Filename.concat Examples.folder (name ^ ".dol") in
  let ok = function Ok x -> x | Error e -> Alcotest.failf "%a" Dolphin_app.Error.pp e in
  let program = ok (Dolphin_app.Program_file.load path) in
  let { Dolphin_app.Fleet_file.scenario; _ } = ok (Dolphin_app.Fleet_file.load_for ~program:path None) in
  (options program.program scenario, scenario.vehicles)

let test_example name () =
  let options, vehicles = read_example name in
  Alcotest.(check bool) "the same" true (is_same ~vehicles { Limits.none with max_states = Some 1_000 } options)

(* {1 Ends} *)

(* Some millions of states. *)
let large = fst (read_example "missions/barrier")

let small = Random_missions.(options (Mission "execute idle(1)\n", (5, Same), ("as planned", answering)))
let here = Unix.getpid ()

(* [elsewhere ()] is called whenever the other process looks at its limits. *)
let limits elsewhere =
  let clock () =
    if Unix.getpid () <> here then elsewhere ();
    Unix.gettimeofday ()
  in
  { Limits.none with clock }

let kill () = Unix.kill (Unix.getpid ()) Sys.sigkill
let rec wait () = Unix.sleepf 10.; wait ()

let stopped (o : Timing.outcome) =
  Alcotest.(check bool) "no process is left" true (no_child ());
  Option.map (Format.asprintf "%a" Limits.pp_bound) o.stopped

let check_stopped expected bound = Alcotest.(check (option string)) "stopped" (Some expected) bound
let ended how = "a worker process ended early, " ^ how
let timing ?(workers = 2) limits options = Timing.run ~workers ~fork_from:1 limits options

(* While this process searches, too. *)
let test_killed () =
  check_stopped (ended "killed") (stopped (timing (limits kill) small));
  check_stopped (ended "killed") (stopped (timing { (limits kill) with max_states = Some 10_000 } large))

let test_exception () =
  check_stopped (ended "with status 1") (stopped (timing (limits (fun () -> raise Exit)) small))

let interrupted limits =
  let until = Unix.gettimeofday () +. 0.5 in
  { limits with Limits.interrupted = (fun () -> Unix.gettimeofday () > until) }

let test_interrupted () =
  check_stopped "it was interrupted" (stopped (timing (interrupted (limits wait)) small));
  check_stopped "it was interrupted" (stopped (timing (interrupted (limits wait)) large))

(* Only this process is told of reports, which are due at once. *)
let test_reports () =
  let reported = ref [] in
  let limits = limits (fun () -> Unix.sleepf 0.1) in
  let progress (p : Limits.progress) =
    if Unix.getpid () <> here then exit 3;
    reported := p.phase :: !reported
  in
  let o = timing { limits with progress; clock = (fun () -> 100. *. limits.clock ()) } small in
  Alcotest.(check (option string)) "all is found" None (stopped o);
  Alcotest.(check bool) "reports" true (List.mem "earliest dates" !reported)

let test_one_process () =
  let found = timing { (limits kill) with max_memory = Some 1_000_000_000 } small in
  Alcotest.(check (option string)) "with a bound on memory there is no other" None (stopped found);
  Alcotest.(check (option string)) "nor if it is not asked for" None (stopped (timing ~workers:1 (limits kill) small))

let slacks limits =
  let options =
    let program = "v = pick { type 'UAV' }\nexecute v: task('p') >> task('q')\n" in
    Random_missions.(options (Mission program, (5, By_plan), ("as planned", answering))) in
  let o = Timing.run Limits.none options in
  let { Timing.known; cut_short } = Timing.slacks ~workers:2 ~fork_from:1 limits options o in
  Alcotest.(check bool) "no process is left" true (no_child ());
  Alcotest.(check int) "tasks" 2 (List.length o.tasks);
  Alcotest.(check int) "none is known" 0 (List.length known);
  Option.map (Format.asprintf "%a" Limits.pp_bound) cut_short

let test_slacks () =
  check_stopped (ended "killed") (slacks (limits kill));
  check_stopped "it was interrupted" (slacks (interrupted (limits wait)))

let () =
  let case name f = Alcotest.test_case name `Quick f in
  let example name = case name (test_example name) in
  Alcotest.run "workers of time"
    [ ("random programs", [ case "workers make no difference" test_random ]);
      ("examples", List.map example (Examples.with_fleets ()));
      ("ends",
       [ case "killed" test_killed; case "an exception" test_exception; case "interrupted" test_interrupted;
         case "reports" test_reports; case "one process" test_one_process; case "slacks" test_slacks ]) ]
