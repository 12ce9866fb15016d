open Dolphin_semantics
open Dolphin_runtime
open Lwt.Infix
open Programs

let case name test = Alcotest.test_case name `Quick test
let never : unit Lwt.t = fst (Lwt.wait ())

(* A console that answers from a list, and everything that was shown. *)
let console_of ?(answer = fun _ -> Lwt.return (Error "end of input")) () =
  let shown = ref [] in
  let show text = shown := text :: !shown in
  let ask prompt =
    show ("? " ^ prompt);
    answer prompt
  in
  ({ Console.say = show; ask; refused = (fun why -> show ("refused: " ^ why)) }, fun () -> List.rev !shown)

let quiet = fst (console_of ())

let deadline = 60.

let start (module P : Platform.S with type t = Mock_platform.t) ?observer ?host ?inputs ?(console = quiet)
    ?(interruption = never) ?again ?always_telemetry mock program =
  Lwt_unix.with_timeout deadline (fun () ->
      Driver.run (module P) mock ?always_telemetry ?observer ?host ?inputs ~console ~interruption ?again program)

let run ?(platform = (module Mock_platform.Virtual : Platform.S with type t = Mock_platform.t)) ?observer ?host
    ?inputs ?console ?interruption ?again ?always_telemetry mock program =
  Lwt_main.run (start platform ?observer ?host ?inputs ?console ?interruption ?again ?always_telemetry mock program)

let outcome_is expected outcome = Alcotest.(check string) "outcome" expected (Fmt.str "%a" Driver.pp_outcome outcome)
let log_is mock expected = Alcotest.(check (list string)) "log" expected (Mock_platform.log mock)
let texts = Alcotest.(check (list string))
let two_vehicles = [ Mock_platform.seen 0. "v1"; Mock_platform.seen 0. "v2" ]
let paced = (module Mock_platform.Paced : Platform.S with type t = Mock_platform.t)

(* {1 Tasks and timers} *)

let runs_tasks () =
  let mock = Mock_platform.make two_vehicles in
  let console, shown = console_of () in
  let t = parallel (sequence (task "a") (task "b")) (task "c") in
  run ~console mock (program [ pick_all (); call Execute [ t ]; call Message [ string "done" ] ])
  |> outcome_is "end";
  log_is mock
    [ "0 telemetry true"; "10 bind v1 v2"; "10 start v1 a"; "10 start v2 c"; "10 telemetry false"; "20 start v1 b";
      "30 release v1 v2"; "30 close" ];
  texts "shown" [ "done" ] (shown ())

let waits_for_vehicles () =
  let events = [ Mock_platform.seen 0. "v1"; Mock_platform.seen 4. "v2"; Mock_platform.seen 5. "v3" ] in
  let mock = Mock_platform.make events in
  run mock (program [ pick 2; call Pause [ number 20. ] ]) |> outcome_is "end";
  log_is mock [ "0 telemetry true"; "4 bind v1 v2"; "4 telemetry false"; "24 release v1 v2"; "24 close" ]

let gives_up_looking () =
  let mock = Mock_platform.make [] in
  run mock (program [ pick 1 ]) |> outcome_is "end: could not pick 1 vehicle: no vehicle was heard of";
  log_is mock [ "0 telemetry true"; "10 close" ]

let looks_at_once () =
  let mock = Mock_platform.make two_vehicles in
  run mock (program [ pick_all ~timeout:0. () ]) |> outcome_is "end";
  log_is mock [ "0 telemetry true"; "0 bind v1 v2"; "0 release v1 v2"; "0 close" ]

let cuts_off () =
  let fate _ _ = Mock_platform.Goes_on in
  let mock = Mock_platform.make ~fate two_vehicles in
  let during = call (Make_during Completes) [ number 7.; task "a" ] in
  run mock (program [ pick_all (); call Execute [ parallel during (call Make_idle [ number 9. ]) ] ])
  |> outcome_is "end";
  log_is mock
    [ "0 telemetry true"; "10 bind v1 v2"; "10 start v1 a"; "10 telemetry false"; "17 stop v1"; "19 release v1 v2";
      "19 close" ]

let stops_siblings () =
  let fate v _ = if v = "v2" then Mock_platform.Fails (3., "leak") else Succeeds 10. in
  let mock = Mock_platform.make ~fate two_vehicles in
  run mock (program [ pick_all (); call Execute [ parallel (task "a") (task "b") ] ])
  |> outcome_is "end: b failed on v2: leak";
  log_is mock
    [ "0 telemetry true"; "10 bind v1 v2"; "10 start v1 a"; "10 start v2 b"; "10 telemetry false"; "13 stop v1";
      "13 release v1 v2"; "13 close" ]

let handles_failures () =
  let fate _ _ = Mock_platform.Fails (3., "leak") in
  let mock = Mock_platform.make ~fate two_vehicles in
  let console, shown = console_of () in
  let t = call Make_watch [ task "a"; handler (block [ call Message [ string "ignored" ]; call Ignore [] ]) ] in
  run ~console mock (program [ pick_all (); call Execute [ t ] ]) |> outcome_is "end";
  texts "shown" [ "ignored" ] (shown ())

(* {1 Sensors} *)

let telemetry_while_it_matters () =
  let events = two_vehicles @ [ Mock_platform.seen ~battery:0.5 20. "v1"; Mock_platform.seen ~battery:0.2 30. "v1" ] in
  let mock = Mock_platform.make events in
  let low = below (call (Sensor_of Battery) [ global 0 ]) (number 0.3) in
  let t = call Make_wait_for [ code low; task "home" ] in
  run mock (program ~reads_sensors:true ~globals:1 [ set_global 0 (pick 1); call Execute [ t ] ]) |> outcome_is "end";
  log_is mock [ "0 telemetry true"; "0 bind v1"; "30 start v1 home"; "40 release v1"; "40 close" ]

(* A value that a guard waits for and a vehicle has not reported is reported once; then the vehicle reports it. *)
let says_what_is_unknown () =
  let seen battery time = Mock_platform.seen ~battery time "v1" in
  let mock = Mock_platform.make [ Mock_platform.silent 0. "v1"; Mock_platform.silent 5. "v1"; seen 0.9 20.; seen 0.2 30. ] in
  let said = ref [] in
  let unknown ~time (fault : Fault.t) = said := Printf.sprintf "%g %s" time fault.message :: !said in
  let low = below (call (Sensor_of Battery) [ global 0 ]) (number 0.3) in
  let t = call Make_wait_for [ code low; task "home" ] in
  run ~observer:{ Observer.nobody with unknown } mock
    (program ~reads_sensors:true ~globals:1 [ set_global 0 (pick 1); call Execute [ t ] ])
  |> outcome_is "end";
  texts "said" [ "0 battery(v1) is unknown, since v1 has not reported it: battery(v) ?: x takes x then" ] !said;
  log_is mock [ "0 telemetry true"; "0 bind v1"; "30 start v1 home"; "40 release v1"; "40 close" ]

(* The platform knows that the battery stays as it is. *)
let quiet () =
  let mock = Mock_platform.make (two_vehicles @ [ (20., Dolphin_runtime.Platform.Quiet) ]) in
  let low = below (call (Sensor_of Battery) [ global 0 ]) (number 0.3) in
  let t = call Make_wait_for [ code low; task "home" ] in
  run mock (program ~reads_sensors:true ~globals:1 [ set_global 0 (pick 1); call Execute [ t ] ])
  |> outcome_is "stuck: nothing can make these guards true any more: oneOf { when { code } then home[v1] }"

let telemetry_for_displays () =
  let mock = Mock_platform.make two_vehicles in
  run ~always_telemetry:true mock (program [ pick_all (); call Execute [ task "a" ] ]) |> outcome_is "end";
  log_is mock [ "0 telemetry true"; "10 bind v1 v2"; "10 start v1 a"; "20 release v1 v2"; "20 close" ]

(* {1 The date} *)

let now = call Now []
let from e n = apply (Binary Greater_equal) [ e; n ]
let home guard = call Execute [ call Make_wait_for [ code guard; task "home" ] ]
let dated = program ~reads_now:true ~globals:2

(* Nothing happens but that time passes. *)
let wakes_at_a_date () =
  let mock = Mock_platform.make two_vehicles in
  run mock (dated [ pick_all (); home (from now (number 59.5)) ]) |> outcome_is "end";
  log_is mock
    [ "0 telemetry true"; "10 bind v1 v2"; "10 telemetry false"; "60 start v1 home"; "70 release v1 v2"; "70 close" ]

let wakes_after_a_while () =
  let mock = Mock_platform.make two_vehicles in
  let since = apply (Binary Subtract) [ now; global 0 ] in
  run mock
    (dated [ pick_all (); set_global 0 now; set_global 1 (number 30.); home (from since (global 1));
             call Execute [ sequence (call Make_idle [ number 5. ]) (task "a") ] ])
  |> outcome_is "end";
  log_is mock
    [ "0 telemetry true"; "10 bind v1 v2"; "10 telemetry false"; "40 start v1 home"; "55 start v1 a";
      "65 release v1 v2"; "65 close" ]

(* Values that cannot be foreseen are looked at each second. *)
let looks_each_second () =
  let mock = Mock_platform.make two_vehicles in
  let rest = apply (Binary Remainder) [ now; number 7. ] in
  run mock (dated [ pick_all (); home (apply (Binary Equal) [ rest; number 2. ]) ]) |> outcome_is "end";
  log_is mock
    [ "0 telemetry true"; "10 bind v1 v2"; "10 telemetry false"; "16 start v1 home"; "26 release v1 v2"; "26 close" ]

let after_the_last_date () =
  let mock = Mock_platform.make two_vehicles in
  run mock (dated [ pick_all (); home (below now (number 5.)) ])
  |> outcome_is "stuck: nothing can make these guards true any more: oneOf { when { code } then home[v1] }"

(* A script that never waits still hears of its vehicles where time passes by itself. *)
let busy_scripts_hear () =
  let mock = Mock_platform.make [ Mock_platform.seen 0. "v1"; Mock_platform.seen ~battery:0.2 1. "v1" ] in
  let high = below (number 0.3) (call (Sensor_of Battery) [ global 0 ]) in
  run ~platform:paced mock
    (program ~reads_sensors:true ~globals:1 [ set_global 0 (pick 1); loop high (constant Null) ])
  |> outcome_is "end"

(* {1 Guards} *)

let deadlock () =
  let mock = Mock_platform.make two_vehicles in
  let wait key = call Make_condition [ code (call (Consume [ Some key ]) [ number 1. ]) ] in
  let outcome =
    run mock (program [ pick_all (); call Execute [ parallel (task "a") (sequence (wait "x") (task "b")) ] ])
  in
  outcome_is "stuck: nothing can make these guards true any more: (condition { code } >> b[v2])" outcome;
  (match outcome with
   | Stuck r -> Alcotest.(check int) "guards" 1 (List.length (Driver.guards r))
   | Ended _ | Spins _ -> Alcotest.fail "ended");
  log_is mock
    [ "0 telemetry true"; "10 bind v1 v2"; "10 start v1 a"; "10 telemetry false"; "20 release v1 v2"; "20 close" ]

let no_deadlock () =
  let mock = Mock_platform.make two_vehicles in
  let one = number 1. in
  let post = call Make_action [ code (call (Post [ Some "x" ]) [ one ]) ] in
  let wait = call Make_condition [ code (call (Consume [ Some "x" ]) [ one ]) ] in
  let late = sequence (call Make_idle [ number 5. ]) post in
  run mock (program [ pick_all (); call Execute [ parallel (sequence wait (task "b")) late ] ]) |> outcome_is "end";
  log_is mock
    [ "0 telemetry true"; "10 bind v1 v2"; "10 telemetry false"; "15 start v1 b"; "25 release v1 v2"; "25 close" ]

(* {1 The console and the host} *)

let asks_again () =
  let answers = ref [ ")"; "1 +" ] in
  let answer _ =
    match !answers with
    | [] -> Lwt.return (Error "end of input")
    | text :: others ->
      answers := others;
      Lwt.pause () >|= fun () -> Ok text
  in
  let console, shown = console_of ~answer () in
  let mock = Mock_platform.make [] in
  run ~console mock (program [ call Ask [ string "radius?" ] ])
  |> outcome_is "end: no answer to 'radius?': end of input";
  match shown () with
  | [ "? radius?"; first; "? radius?"; second; "? radius?" ] ->
    List.iter (fun text -> Alcotest.(check string) "refused" "refused: " (String.sub text 0 9)) [ first; second ]
  | shown -> texts "shown" [] shown

let asks () =
  let answers = ref [ ")"; "1 + 1" ] in
  let answer _ =
    match !answers with
    | [] -> Lwt.return (Error "end of input")
    | text :: others -> answers := others; Lwt.return (Ok text)
  in
  let console, shown = console_of ~answer () in
  let mock = Mock_platform.make [] in
  run ~console mock (program [ call Message [ call Ask [ string "radius?" ] ] ]) |> outcome_is "end";
  match shown () with
  | [ "? radius?"; refused; "? radius?"; "2" ] ->
    Alcotest.(check string) "refused" "refused: " (String.sub refused 0 9)
  | shown -> texts "shown" [] shown


let time_stands_still () =
  let mock = Mock_platform.make (two_vehicles @ [ Mock_platform.seen 100. "v3" ]) in
  let host ~site:_ ~subject:_ ~member:_ ~arguments:_ = Lwt_unix.sleep 0.05 >|= fun () -> Ok Core.Null in
  run ~host mock (program [ pick 1; call Get_supplier []; call Execute [ task "a" ] ]) |> outcome_is "end";
  log_is mock
    [ "0 telemetry true"; "0 bind v1"; "0 telemetry false"; "0 start v1 a"; "10 release v1"; "10 close" ]

let news_while_waiting () =
  let seen = ref [] in
  let first, heard = Lwt.wait () in
  let news ~time:_ (state : World.vehicle_state) =
    seen := state.id :: !seen;
    if state.id = "v2" then Lwt.wakeup_later heard ()
  in
  let host ~site:_ ~subject:_ ~member:_ ~arguments:_ = first >|= fun () -> Ok Core.Null in
  let mock = Mock_platform.make [ Mock_platform.seen 1. "v1"; Mock_platform.seen 2. "v2" ] in
  run ~platform:paced ~host ~observer:{ Observer.nobody with news } mock (program [ call Get_supplier [] ])
  |> outcome_is "end";
  texts "seen" [ "v1"; "v2" ] (List.rev !seen)

let calls_the_host () =
  let calls = ref [] in
  let host ~site:_ ~subject ~member ~arguments =
    calls := (subject, member, Option.map List.length arguments) :: !calls;
    Lwt.return (Ok (if member = "size" then Core.Integer 3 else Core.Host "queue"))
  in
  let console, shown = console_of () in
  let mock = Mock_platform.make [] in
  let queue = property (call Get_supplier []) "queue" in
  run ~console ~host mock (program [ call Message [ method_of queue "size" [ number 1. ] ] ]) |> outcome_is "end";
  texts "shown" [ "3" ] (shown ());
  Alcotest.(check (list (triple (option string) string (option int))))
    "calls"
    [ (None, "getSupplier", Some 0); (Some "queue", "queue", None); (Some "queue", "size", Some 1) ]
    (List.rev !calls)

let without_host () =
  let mock = Mock_platform.make [] in
  run mock (program [ call Get_supplier [] ])
  |> outcome_is "end: getSupplier: no host process to call: name one with --supplier"

(* {1 Inputs} *)

(* An input comes when the end of the first task, or its timer, is in the driver's hands already, and the input cuts
   the task off. That event is of a task that no longer runs: it is not the end of the next task on the same vehicle,
   by the same timer. *)
let overtaken text ~event ~expected () =
  let inputs = Inputs.create () in
  let module Together = struct
    include Mock_platform.Paced

    let next m =
      Mock_platform.Virtual.next m >|= fun told ->
      if told = event then ignore (Inputs.post inputs "abort" (Boolean true));
      told
  end
  in
  let mock = Mock_platform.make [ Mock_platform.seen 0. "v1" ] in
  let program = Test_support.Pure_run.compile_exn ("input 'abort'\nv = pick { count 1 }\n" ^ text) in
  run ~platform:(module Together) ~inputs mock program |> outcome_is "end";
  log_is mock expected

let overtaken_end =
  overtaken "execute until { consume abort: true } run task('a')\nexecute task('b')"
    ~event:(Platform.Task_done "v1")
    ~expected:
      [ "0 telemetry true"; "0 bind v1"; "0 start v1 a"; "0 telemetry false"; "10 stop v1"; "10 start v1 b";
        "20 release v1"; "20 close" ]

let overtaken_timer =
  overtaken "execute until { consume abort: true } run (idle 5.seconds)\nexecute idle 7.seconds"
    ~event:(Platform.Timer 1)
    ~expected:[ "0 telemetry true"; "0 bind v1"; "0 telemetry false"; "12 release v1"; "12 close" ]

(* {1 Interruption} *)

let interrupted_at_once () =
  let mock = Mock_platform.make two_vehicles in
  run ~interruption:Lwt.return_unit mock (program [ pick_all () ]) |> outcome_is "end: interrupted";
  log_is mock [ "0 close" ]

let soon () = Lwt_unix.sleep 0.05

let interrupted_in_loop () =
  let mock = Mock_platform.make two_vehicles in
  run ~interruption:(soon ()) mock (program [ pick_all (); loop (constant (Boolean true)) (constant Null) ])
  |> outcome_is "end: interrupted";
  log_is mock [ "0 telemetry true"; "10 bind v1 v2"; "10 release v1 v2"; "10 close" ];
  let console, _ = console_of () in
  let mock = Mock_platform.make [] in
  run ~console ~interruption:(soon ()) mock
    (program [ loop (constant (Boolean true)) (call Message [ string "again" ]) ])
  |> outcome_is "end: interrupted"

let interrupted_in_task () =
  let fate _ _ = Mock_platform.Goes_on in
  let mock = Mock_platform.make ~fate two_vehicles in
  run ~interruption:(soon ()) mock (program [ pick_all (); call Execute [ parallel (task "a") (task "b") ] ])
  |> outcome_is "end: interrupted";
  log_is mock
    [ "0 telemetry true"; "10 bind v1 v2"; "10 start v1 a"; "10 start v2 b"; "10 telemetry false"; "10 stop v1";
      "10 stop v2"; "10 release v1 v2"; "10 close" ]

let interrupted_in_question () =
  let promise, _ = Lwt.task () in
  let console, _ = console_of ~answer:(fun _ -> promise) () in
  let mock = Mock_platform.make [] in
  run ~console ~interruption:(soon ()) mock (program [ call Ask [ string "well?" ] ]) |> outcome_is "end: interrupted";
  Alcotest.(check bool) "the question is cancelled" true (Lwt.state promise = Lwt.Fail Lwt.Canceled)

(* Its first interruption begins the way home, the second one ends it. *)
let interrupted_on_the_way () =
  let home fate =
    let mock = Mock_platform.make ~fate two_vehicles in
    let again = Lwt_unix.sleep 0.15 in
    run ~interruption:(soon ()) ~again mock
      (on_interrupt (task "home") (program [ pick_all (); call Execute [ task "a" ] ]))
    |> outcome_is "end: interrupted";
    mock
  in
  let log end_of_home =
    [ "0 telemetry true"; "10 bind v1 v2"; "10 start v1 a"; "10 telemetry false"; "10 stop v1"; "10 start v1 home" ]
    @ end_of_home
  in
  log_is (home (fun _ _ -> Mock_platform.Goes_on)) (log [ "10 stop v1"; "10 release v1 v2"; "10 close" ])

let no_answer_on_the_way () =
  let promise, _ = Lwt.task () in
  let console, _ = console_of ~answer:(fun _ -> promise) () in
  let mock = Mock_platform.make two_vehicles in
  run ~console ~interruption:(soon ()) mock
    (on_interrupt (task "home") (program [ pick_all (); call Ask [ string "well?" ] ]))
  |> outcome_is "end: interrupted";
  Alcotest.(check bool) "the question is cancelled" true (Lwt.state promise = Lwt.Fail Lwt.Canceled)

(* The real thing: a process that never replies. *)
let interrupted_in_call () =
  match Host.start "sleep 30" with
  | Error why -> Alcotest.fail why
  | Ok host ->
    let mock = Mock_platform.make [] in
    run ~host:(Host.call host) ~interruption:(soon ()) mock (program [ call Get_supplier [] ])
    |> outcome_is "end: interrupted";
    Lwt_main.run (Host.close host)

(* A stream of events that come at once and change nothing. *)
let interrupted_in_flood () =
  let flood = List.init 100_000 (fun i -> Mock_platform.seen (float_of_int i) "v1") in
  let mock = Mock_platform.make flood in
  run ~interruption:(Lwt.pause ()) mock (program [ call Pause [ number 1e6 ] ]) |> outcome_is "end: interrupted"

(* {1 Observers and accidents} *)

let told_ahead () =
  let mock = Mock_platform.make two_vehicles in
  let behind = ref 0 in
  let transition ~time:_ ~cause:_ (t : Transition.t) =
    let logged = List.length (Mock_platform.log mock) in
    (match t.label with
     | Start _ -> if logged <> !behind + 2 then Alcotest.failf "%d commands before a start" logged; incr behind
     | _ -> ())
  in
  run ~observer:{ Observer.nobody with transition } mock
    (program [ pick_all (); call Execute [ parallel (task "a") (task "b") ] ])
  |> outcome_is "end";
  Alcotest.(check int) "starts" 2 !behind

let broken_run ?observer mock =
  let whole () =
    start (module Mock_platform.Virtual) ?observer mock
      (program [ pick_all (); call Execute [ parallel (task "a") (task "b") ] ])
  in
  let failure error = Lwt.return (Printexc.to_string error) in
  Lwt_main.run (Lwt.try_bind whole (fun _ -> Lwt.return "no exception") failure)

let broken_observer () =
  let mock = Mock_platform.make two_vehicles in
  let transition ~time:_ ~cause:_ (t : Transition.t) =
    match t.label with Start ("v2", _) -> failwith "disk full" | _ -> ()
  in
  Alcotest.(check string) "failure" "Failure(\"disk full\")"
    (broken_run ~observer:{ Observer.nobody with transition } mock);
  log_is mock
    [ "0 telemetry true"; "10 bind v1 v2"; "10 start v1 a"; "10 stop v1"; "10 release v1 v2"; "10 close" ]

let broken_platform () =
  let mock = Mock_platform.make two_vehicles in
  Mock_platform.fail_on_start mock;
  Alcotest.(check string) "failure" "Failure(\"no link\")" (broken_run mock);
  log_is mock [ "0 telemetry true"; "10 bind v1 v2"; "10 stop v1"; "10 release v1 v2"; "10 close" ]

(* {1 Scale} *)

let thousand_branches () =
  let names = repeat 1000 (Printf.sprintf "v%d") in
  let mock = Mock_platform.make (List.map (Mock_platform.seen 0.) names) in
  let transitions = ref 0 in
  let executed = ref 0. in
  let transition ~time:_ ~cause:_ (t : Transition.t) =
    match t.label with
    | Execute -> executed := Sys.time ()
    | Start _ | Done _ -> incr transitions
    | _ -> ()
  in
  let branch i =
    match repeat 10 (fun j -> task (Printf.sprintf "t%d.%d" i j)) with
    | first :: others -> List.fold_left sequence first others
    | [] -> assert false
  in
  let all = match repeat 1000 branch with b :: others -> List.fold_left parallel b others | [] -> assert false in
  let began = Sys.time () in
  run ~observer:{ Observer.nobody with transition } mock (program [ pick_all (); call Execute [ all ] ])
  |> outcome_is "end";
  Printf.printf "allocation: %.2f s; then %d transitions: %.2f s\n" (!executed -. began) !transitions
    (Sys.time () -. !executed);
  Alcotest.(check int) "starts and ends" 20_000 !transitions

let tests =
  [ case "tasks start and end in order" runs_tasks;
    case "a pick waits for vehicles" waits_for_vehicles;
    case "a pick gives up after the announce period" gives_up_looking;
    case "a pick may look at once" looks_at_once;
    case "during and idle take their time" cuts_off;
    case "an end that an input has overtaken is not taken for the next task's" overtaken_end;
    case "nor is a timer" overtaken_timer;
    case "an error stops the siblings" stops_siblings;
    case "a handled error does not" handles_failures;
    case "telemetry is on while it matters" telemetry_while_it_matters;
    case "what a vehicle has not told is said once" says_what_is_unknown;
    case "a deadlock on a battery is found" quiet;
    case "a guard wakes at its date" wakes_at_a_date;
    case "and so long after another one" wakes_after_a_while;
    case "a guard of another kind is asked each second" looks_each_second;
    case "after the last date nothing wakes" after_the_last_date;
    case "telemetry is on for displays" telemetry_for_displays;
    case "a busy script hears of its vehicles" busy_scripts_hear;
    case "a deadlock of guards is found" deadlock;
    case "a guard that may come true is no deadlock" no_deadlock;
    case "a bad answer is asked for again" asks_again;
    case "an answer has a value" asks;
    case "virtual time stands still for the host" time_stands_still;
    case "real time goes on meanwhile" news_while_waiting;
    case "host calls get their replies" calls_the_host;
    case "without a host calls fail" without_host;
    case "interrupted before it began" interrupted_at_once;
    case "interrupted in an endless loop" interrupted_in_loop;
    case "interrupted while tasks run" interrupted_in_task;
    case "interrupted while a question is open" interrupted_in_question;
    case "interrupted again on the way home" interrupted_on_the_way;
    case "interrupted while a question is open, with a way home" no_answer_on_the_way;
    case "interrupted while the host hangs" interrupted_in_call;
    case "interrupted among many events" interrupted_in_flood;
    case "observers are told ahead" told_ahead;
    case "a broken observer ends the run safely" broken_observer;
    case "a broken platform ends the run safely" broken_platform;
    case "1,000 branches of 10 tasks" thousand_branches ]
