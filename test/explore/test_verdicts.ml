(* Each property, kept and violated by a small program, with the length of the shortest run that shows it; and the
   effect of bounds on verdicts. *)

open Dolphin_environment
open Dolphin_checker
open Dolphin_explore
open Test_support
module Property = Dolphin_explore.Property

let world = Pure_run.world [ Pure_run.vehicle "a"; Pure_run.vehicle "b" ~north:100. ]
let options = Search.default
let limited limits = { options with limits }

let run ?(options = options) source =
  let program = Pure_run.compile_exn source in
  (program, Search.run options program world)

let text verdict =
  match (verdict : Search.verdict) with
  | Holds -> "holds"
  | Holds_if needs -> Format.asprintf "holds %a" Search.pp_needs needs
  | Violated { steps; cycle = [] } -> Printf.sprintf "violated in %d" (List.length steps)
  | Violated { steps; cycle } -> Printf.sprintf "for ever %d+%d" (List.length steps) (List.length cycle)
  | Unreached pieces -> "unreached: " ^ String.concat ", " (List.map (fun (p : Coverage.piece) -> p.what) pieces)
  | By_design { repeats; left_by; _ } ->
    Printf.sprintf "by design, by %d, until %s" (List.length repeats) (String.concat ", " left_by)
  | Inconclusive _ -> "inconclusive"

let check ?options property source expected () =
  let _, o = run ?options source in
  Alcotest.(check string) (Property.name property) expected (text (List.assoc property o.verdicts))

let failing = { options with environment = Environment.failing options.environment }
let interrupted =
  { options with environment = { options.environment with faults = { Faults.none with interrupt = true } } }
let posting ~certain =
  let input = { (List.hd Posts.once) with certain } in
  { options with environment = { options.environment with inputs = [ input ] } }

let agreed = { options with environment = { options.environment with answers = (fun _ -> [ [ "yes" ] ]) } }
let supplied = { options with environment = { options.environment with replies = Calls.replies } }
let pick = "va = pick { id 'a' }\nvb = pick { id 'b' }\n"

let verdicts : (string * (unit -> unit)) list =
  [
    ("a condition that comes true",
     check No_deadlock "execute condition { consume x:1 } | action { post x:1 }" "holds");
    ("a condition that never does", check No_deadlock "execute condition { consume x:1 }" "violated in 1");
    ("two wait for each other",
     check No_deadlock
       "t = (condition { consume x:1 } >> action { post y:1 }) | (condition { consume y:1 } >> action { post x:1 })\n\
        execute t"
       "violated in 1");
    ("a loop that ends", check Termination "for (i in 1..3) { execute action { } }" "holds");
    ("a loop that does not", check Termination "while (true) { execute action { } }" "for ever 1+2");
    ("a loop over platform tasks", check Termination (pick ^ "while (true) { execute task('p')[va] }") "for ever 5+3");
    ("a loop that may end or not",
     check Termination
       "while (!poll(stop: 1)) { execute oneOf {\nwhen { true } then action { }\n\
        when { true } then action { post stop:1 }\n} }"
       "for ever 1+3");
    ("a task that may fail", check ~options:failing No_error (pick ^ "execute task('p')[va]") "violated in 7");
    ("a failure that is handled",
     check ~options:failing No_error (pick ^ "execute watch task('p')[va] onError { ignore() }") "holds");
    ("an error of the script", check No_error "x = 1 / 0" "violated in 1");
    ("nobody answers", check No_error "x = ask 'how many?'" "violated in 2");
    ("an answer",
     check ~options:{ options with environment = { options.environment with answers = (fun _ -> [ [ "2" ] ]) } }
       No_error "x = ask 'how many?'" "holds");
    ("nobody replies", check No_error "s = getSupplier()" "violated in 2");
    ("a reply", check ~options:supplied No_error "s = getSupplier()" "holds");
    ("a reply that fails", check ~options:supplied No_error "s = getSupplier()\ns.next()\ns.next()" "violated in 6");
    ("a supplier that comes to its end",
     check ~options:supplied Termination "s = getSupplier()\nwhile (s.ready()) { message 'on' }" "holds");
    ("a supplier that does not",
     check ~options:supplied Termination "s = getSupplier()\nwhile (s.next()) { }" "for ever 5+2");
    ("interrupted before it takes what it posted",
     check ~options:interrupted No_leftover "post x:1\nconsume x:1" "holds");
    ("interrupted where nothing else can happen",
     check ~options:interrupted No_deadlock "execute condition { consume x:1 }" "violated in 1");
    ("interrupted in a script that waits for nobody",
     check ~options:interrupted No_error "x = ask 'how many?'" "violated in 2");
    ("an input that need not come",
     check ~options:(posting ~certain:false) No_deadlock "input 'x'\nexecute condition { consume x:1 }" "violated in 1");
    ("an input that comes",
     check ~options:(posting ~certain:true) No_deadlock "input 'x'\nexecute condition { consume x:1 }" "holds");
    ("an input that comes once",
     check ~options:(posting ~certain:true) No_deadlock "input 'x'\nexecute condition { consume x:1 } >> condition { consume x:1 }"
       "violated in 3");
    ("an input that is not declared",
     check ~options:(posting ~certain:true) No_deadlock "execute condition { consume x:1 }" "violated in 1");
    ("an input that nobody took",
     check ~options:(posting ~certain:false) No_leftover "input 'x'\npause 1" "holds");
    ("an input that nobody took, and a pair of the program",
     check ~options:(posting ~certain:false) No_leftover "input 'x'\npost y:1\npause 1" "violated in 4");
    ("a pair of the program with the key of an input",
     check ~options:(posting ~certain:false) No_leftover "input 'x'\npost x:2\npause 1" "holds");
    ("a loop until an input comes",
     check ~options:(posting ~certain:true) Termination "input 'x'\nwhile (!poll(x:1)) { pause 1 }" "for ever 1+2");
    ("a loop that only an interruption ends",
     check ~options:interrupted Termination "while (true) { execute action { } }" "for ever 1+2");
    ("vehicles that are not there", check Vehicles "v = pick { type 'UAV' }" "violated in 2");
    ("too few vehicles", check Allocation (pick ^ "execute task('p') | task('q') | task('r')") "violated in 5");
    ("too few vehicles to pick", check Vehicles "v = pick { count 3; type 'UUV'; timeout 1.seconds }" "violated in 2");
    ("a halt in a handler",
     check ~options:failing No_halt (pick ^ "execute watch task('p')[va] onError { halt 'no' }") "violated in 7");
    ("a halt that is not reached", check No_halt "if (1 > 2) { halt 'no' }" "holds");
    ("tuples left over", check No_leftover "execute action { post x:1 }" "violated in 3");
    ("tuples taken", check No_leftover "post x:1\nconsume x:1" "holds");
    ("all of it reached",
     check All_reached (pick ^ "execute task('p')[va] | action { post x:1 }\nmessage 'end'") "holds");
    ("a branch that is not taken, and its task",
     check All_reached (pick ^ "execute oneOf { when { false } then task('p')[va]\nwhen { true } then action { } }")
       "unreached: task");
    ("a handler without failures",
     check All_reached (pick ^ "execute watch task('p')[va] onError { message 'm' }") "unreached: onError");
    ("a handler with failures",
     check ~options:failing All_reached (pick ^ "execute watch task('p')[va] onError { message 'm' }") "holds");
    ("a question that confirm need not ask again", check ~options:agreed All_reached "message confirm('Go?')" "holds");
    ("a question that is not asked", check ~options:agreed All_reached "if (1 > 2) { x = confirm('Go?') }"
       "unreached: ask");
    ("a message of the script", check All_reached "if (1 > 2) { message 'm' }" "unreached: message");
  ]

(* A program with some thousands of states, all of whose properties hold. *)
let large =
  let branch _ = "(action { } >> action { } >> action { } >> action { })" in
  "t = " ^ String.concat " | " (List.init 6 branch) ^ "\nexecute t"

let stops name options bound () =
  let _, o = run ~options large in
  Alcotest.(check bool) (name ^ " stops it") true (o.stopped = Some bound);
  let inconclusive (_, verdict) = match (verdict : Search.verdict) with Inconclusive b -> b = bound | _ -> false in
  Alcotest.(check bool) "nothing is said to hold" true (List.for_all inconclusive o.verdicts);
  Alcotest.(check bool) "not all was expanded" true (o.expanded < o.states)

let ticking () =
  let now = ref 0. in
  fun () -> now := !now +. 0.5; !now

let interrupted_after n =
  let asked = ref 0 in
  fun () -> incr asked; !asked > n

(* More than the search ever uses. *)
let most = 1 lsl 40

let bounds =
  [
    ("states", stops "a bound on states" (limited { Limits.none with max_states = Some 50 }) States);
    ("depth", stops "a bound on depth" (limited { Limits.none with max_depth = Some 5 }) Depth);
    ("memory", stops "a bound on memory" (limited { Limits.none with max_memory = Some 1_000 }) Memory);
    ("the process's memory",
     stops "a bound on memory" (limited { Limits.none with max_memory = Some most; memory_taken = (fun () -> Some (most + 1)) })
       Memory);
    ("the machine's memory", stops "no memory" (limited { Limits.none with memory_left = (fun () -> Some 0) }) No_memory);
    ("time", stops "a timeout" (limited { Limits.none with timeout = Some 0.4; clock = ticking () }) Time);
    ("interruption", stops "an interruption" (limited { Limits.none with interrupted = interrupted_after 1 }) Interruption);
  ]

(* {1 Bounds within an expansion}

   Twelve vehicles that may all be late are picked at once: a pick that can bind them in 12! orders. *)

let all_late = { options.environment with faults = { Dolphin_environment.Faults.none with join = Any_number } }
let twelve = Pure_run.world (List.init 12 (fun i -> Pure_run.vehicle (Printf.sprintf "v%d" i)))

let stops_within name limits ~most bound () =
  let search compress =
    let options = { (limited limits) with environment = all_late; compress } in
    let o = Search.run options (Pure_run.compile_exn "vs = pick { count 12 }") twelve in
    Alcotest.(check bool) (name ^ " stops it") true (o.stopped = Some bound);
    if o.states > most then Alcotest.failf "%s: %d states" name o.states
  in
  search false;
  search true

let bounds_within =
  let ticking_clock = { Limits.none with clock = ticking () } in
  let taken_after n =
    let asked = ref 0 in
    fun () -> incr asked; Some (if !asked > n then most + 1 else 1_000)
  in
  let left_after n =
    let asked = ref 0 in
    fun () -> incr asked; Some (if !asked > n then 0 else max_int / 2)
  in
  [
    ("states", stops_within "states" { Limits.none with max_states = Some 1_000 } ~most:1_001 States);
    ("few states", stops_within "few states" { Limits.none with max_states = Some 10 } ~most:11 States);
    ("time", stops_within "time" { ticking_clock with timeout = Some 50. } ~most:105 Time);
    ("memory", stops_within "memory" { ticking_clock with memory_left = left_after 100 } ~most:105 No_memory);
    ("the process's memory",
     stops_within "the process's memory"
       { ticking_clock with max_memory = Some most; memory_taken = taken_after 100 } ~most:105 Memory);
    ("interruption", stops_within "an interruption" { Limits.none with interrupted = interrupted_after 100 } ~most:105
       Interruption);
  ]

(* {1 Bounds after a search}

   The search looks at the clock at each of 70 states, and to show its run does so at each transition. *)

let long_run = "i = 0\nwhile (i < 100000) { i = i + 1 }\nx = [1][2]"
(* The run goes through states in which a step beside it has outcomes that cannot be listed. *)
let beside_unclear () =
  let program =
    Pure_run.compile_exn
      (pick ^ "p = imcPlan { locate 41, -8; goTo(); move 0, 100; goTo() }\n\
               execute (assert({ battery(vb) < 0.3 }, 'a') | condition { p.rest(va) == p } | { task('p') })") in
  let open Dolphin_semantics in
  let world = World.open_sensor Progress "a" [] (World.open_battery "b" [] world) in
  let o = Search.run { options with reduction = All } program world in
  Alcotest.(check string) "the assertion" "violated in 6" (text (List.assoc Property.Assertions o.verdicts))

let is_unshown why = String.starts_with ~prefix:"a violation was found, but " why

let shows_after_search name limits ~shows () =
  let _, o = run ~options:{ (limited limits) with reduction = Partial_order } long_run in
  Alcotest.(check bool) (name ^ " leaves the search alone") true (o.stopped = None);
  match List.assoc Property.No_error o.verdicts with
  | Violated _ -> Alcotest.(check bool) (name ^ ": the run is shown") true shows
  | Inconclusive (Unsettled why) when is_unshown why -> Alcotest.(check bool) (name ^ ": it is not shown") false shows
  | _ -> Alcotest.failf "%s: neither a run, nor the reason why there is none" name

let after_search =
  let timed timeout = { Limits.none with clock = ticking (); timeout = Some timeout } in
  let interrupted = { Limits.none with interrupted = interrupted_after 100 } in
  [ ("enough time", shows_after_search "enough time" (timed 1_000.) ~shows:true);
    ("too little time", shows_after_search "too little time" (timed 50.) ~shows:false);
    ("an interruption", shows_after_search "an interruption" interrupted ~shows:false) ]

(* A run that was found in time is shown, though the search was stopped. *)
let follow_up_after_stop () =
  let now = ref 0. in
  let limits = { Limits.none with timeout = Some 5.; clock = (fun () -> !now) } in
  now := 6.;
  let tick = Limits.follow_up ~stopped:Time ~started:0. limits in
  let stops at =
    now := at;
    match tick () with () -> None | exception Limits.Stop bound -> Some bound
  in
  Alcotest.(check bool) "a second more" true (List.map stops [ 6.; 6.9 ] = [ None; None ]);
  Alcotest.(check bool) "and no longer" true (stops 7.1 = Some Time);
  now := 1.;
  let interrupted = ref true in
  let tick = Limits.follow_up ~started:0. { limits with interrupted = (fun () -> !interrupted) } in
  tick ();
  now := 2.1;
  Alcotest.(check bool) "after an interruption too" true
    (match tick () with () -> false | exception Limits.Stop _ -> true)

(* A hundred parallel parts: the work for one state takes long, and so does the search for alike parts. *)
let parts n task = "execute " ^ String.concat " | " (List.init n task)
let stops_among name reduction task () =
  let limits = { Limits.none with interrupted = interrupted_after 20 } in
  let _, o = run ~options:{ (limited limits) with reduction } (parts 100 task) in
  Alcotest.(check bool) (name ^ " are left") true (o.stopped = Some Interruption);
  if o.states > 25 then Alcotest.failf "%s: %d states" name o.states

let among =
  let posts i = Printf.sprintf "action { post x: %d }" i in
  let differ i = Printf.sprintf "action { post x%d: %d }" i i in
  [ ("alike", stops_among "alike parts" Reduction.Symmetry posts);
    ("by order", stops_among "parts" Reduction.Partial_order differ) ]

(* The error of the last of the parts is the second step of a shortest run. *)
let shows_shortest n expected () =
  let task i = if i = n - 1 then "(action { } >> action { 1 / 0 })" else Printf.sprintf "action { post x%d: 1 }" i in
  let _, o = run ~options:{ options with reduction = Partial_order; search_again = 1_000 } (parts n task) in
  match List.assoc Property.No_error o.verdicts with
  | Violated { shortest; _ } -> Alcotest.(check bool) "shortest" expected shortest
  | Holds | Holds_if _ | By_design _ | Unreached _ | Inconclusive _ -> Alcotest.fail "the error is not found"

(* Found before the bound was met: still a violation. *)
let test_violation_before_bound () =
  let environment = { options.environment with answers = (fun _ -> [ [ "1"; "2" ] ]) } in
  let options = { (limited { Limits.none with max_states = Some 50 }) with environment } in
  let source = "x = ask 'which?'\nif (x == 1) { y = 1 / 0 }\n" ^ large in
  check ~options No_error source "violated in 3" ();
  check ~options No_deadlock source "inconclusive" ()

(* A bound of exactly the number of states is not met. *)
let test_exact_bound () =
  let _, o = run large in
  let _, o' = run ~options:(limited { Limits.none with max_states = Some o.states }) large in
  Alcotest.(check bool) "not stopped" true (o'.stopped = None)

(* Free parts of the heap need not be in the machine's memory. *)
let test_memory_taken () =
  let unwritten = Bytes.create 50_000_000 in
  let stopped memory_taken =
    let _, o = run ~options:(limited { Limits.none with max_memory = Some 40_000_000; memory_taken }) large in
    o.stopped
  in
  Alcotest.(check bool) "it does not count" true (stopped (fun () -> Some 1_000_000) = None);
  Alcotest.(check bool) "unless nothing is known" true (stopped (fun () -> None) = Some Memory);
  ignore (Sys.opaque_identity unwritten)

let test_progress () =
  let reports = ref 0 in
  let options = limited { Limits.none with clock = ticking (); progress = (fun _ -> incr reports) } in
  ignore (run ~options large);
  Alcotest.(check bool) "some reports" true (!reports > 0)

let () =
  let case (name, f) = Alcotest.test_case name `Quick f in
  Alcotest.run "verdicts"
    [
      ("properties", List.map case verdicts);
      ("bounds", List.map case bounds);
      ("bounds within an expansion", List.map case bounds_within);
      ("bounds among many parts", List.map case among);
      ("bounds after a search", List.map case (after_search @ [ ("a search that was stopped", follow_up_after_stop) ]));
      ("beside what is unclear", List.map case [ ("an assertion that fails", beside_unclear) ]);
      ( "shortest runs",
        List.map case [ ("of few parts", shows_shortest 8 true); ("of many parts", shows_shortest 64 false) ] );
      ( "around bounds",
        List.map case
          [ ("a violation before", test_violation_before_bound); ("just met", test_exact_bound);
            ("memory that is not taken", test_memory_taken);
            ("progress", test_progress) ] );
    ]
