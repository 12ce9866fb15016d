(* Slacks that several processes find are those that one finds, on random programs; and how they end. PROGRAMS in the
   environment is how many programs are tried, 120 by default. *)

open Dolphin_time
module Limits = Dolphin_checker.Limits

let programs = match Sys.getenv_opt "PROGRAMS" with Some n -> int_of_string n | None -> 120

let no_child () =
  match Unix.waitpid [ WNOHANG ] (-1) with _ -> false | exception Unix.Unix_error (ECHILD, _, _) -> true

(* {1 The same} *)

let compared = ref 0

let agrees case =
  let options = Random_missions.options case and limits = { Limits.none with max_states = Some 300 } in
  let o = Timed_analysis.run limits options in
  let slacks workers = Timed_analysis.slacks ~workers limits options o in
  o.states > 120
  ||
  let one = slacks 1 in
  if List.length one.known > 1 then Test_support.Property.count compared;
  one = slacks 3 && no_child ()

let test_random () =
  let test =
    QCheck2.Test.make ~count:programs ~print:Random_missions.print ~name:"workers make no difference"
      Random_missions.case agrees
  in
  Test_support.Property.on_each_seed ~usual:20_261_127 ~programs test;
  Printf.printf "%d compared with more than one slack\n" !compared;
  Alcotest.(check bool) "variety" true (!compared * 12 > programs)

(* {1 Ends} *)

let here = Unix.getpid ()

(* [elsewhere ()] is called whenever another process looks at its limits. *)
let limits elsewhere =
  let clock () =
    if Unix.getpid () <> here then elsewhere ();
    Unix.gettimeofday ()
  in
  { Limits.none with clock }

let kill () = Unix.kill (Unix.getpid ()) Sys.sigkill
let rec wait () = Unix.sleepf 10.; wait ()

let slacks ?(workers = 2) limits =
  let options =
    let program = "v = pick { type 'UAV' }\nexecute v: task('p') >> task('q')\n" in
    Random_missions.(options (Mission program, (5, By_plan), ("as planned", answering))) in
  let o = Timed_analysis.run Limits.none options in
  let found = Timed_analysis.slacks ~workers limits options o in
  Alcotest.(check bool) "no process is left" true (no_child ());
  Alcotest.(check int) "tasks" 2 (List.length o.tasks);
  found

let check_stopped expected { Timed_analysis.known; cut_short } =
  Alcotest.(check int) "none is known" 0 (List.length known);
  Alcotest.(check (option string)) "stopped" (Some expected)
    (Option.map (Format.asprintf "%a" Limits.pp_bound) cut_short)

let check_all { Timed_analysis.known; cut_short } =
  Alcotest.(check int) "all are known" 2 (List.length known);
  Alcotest.(check bool) "to the end" true (cut_short = None)

let test_killed () = check_stopped "a worker process ended early, killed" (slacks (limits kill))

let test_exception () =
  check_stopped "a worker process ended early, with status 1" (slacks (limits (fun () -> raise Exit)))

let test_interrupted () =
  let until = Unix.gettimeofday () +. 0.5 in
  let interrupted () = Unix.gettimeofday () > until in
  check_stopped "it was interrupted" (slacks { (limits wait) with interrupted })

(* Only this process gets reports, which are due at once. *)
let test_reports () =
  let reported = ref [] in
  let limits = limits (fun () -> Unix.sleepf 0.1) in
  let progress (p : Limits.progress) =
    if Unix.getpid () <> here then exit 3;
    reported := p.phase :: !reported
  in
  check_all (slacks { limits with progress; clock = (fun () -> 100. *. limits.clock ()) });
  Alcotest.(check bool) "reports" true (List.mem "slack, 0 of 2" !reported)

let test_one_process () =
  check_all (slacks { (limits kill) with max_memory = Some 1_000_000_000 });
  check_all (slacks ~workers:1 (limits kill))

let () =
  let case name f = Alcotest.test_case name `Quick f in
  Alcotest.run "workers of time"
    [ ("random programs", [ case "workers make no difference" test_random ]);
      ("ends",
       [ case "killed" test_killed; case "an exception" test_exception; case "interrupted" test_interrupted;
         case "reports" test_reports; case "one process" test_one_process ]) ]
