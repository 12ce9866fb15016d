open Dolphin_semantics
open Dolphin_trace

let case name test = Alcotest.test_case name `Quick test
let show verdict = Format.asprintf "@[<v>%a@]" Journal_verdict.pp verdict

let is_run name verdict =
  match verdict with
  | Journal_verdict.Run _ -> ()
  | _ -> Alcotest.failf "%s: %s" name (show verdict)

(* {1 What runs write checks} *)

(* Every example, with a few fates. *)
let examples_check () =
  let seeds name = if Sys.file_exists ("../../examples/" ^ name ^ ".py") then [ 0 ] else [ 0; 1; 2; 3 ] in
  let check name seed = is_run name (Runs.check (Runs.run ~seed name)) in
  List.iter (fun name -> List.iter (check name) (seeds name)) Runs.examples

(* One way to write each line. *)
let canonical () =
  let check name line =
    match Entry.of_string line with
    | Ok entry -> Alcotest.(check string) name line (Entry.to_string entry)
    | Error why -> Alcotest.failf "%s: %s: %s" name why line
  in
  List.iter (fun name -> List.iter (check name) (Runs.lines (Runs.run name).journal)) Runs.examples

(* The known vehicles at a transition are those that the program saw, however rare samples are. *)
let sensors () =
  let source =
    {|v = pick { type 'UUV' }
      execute task('a')[v] / { battery(v) < 0.995 } >> waitFor { battery(v) < 0.99 } then action { post b: battery(v) }
      message 'at ' + position(v)|}
  in
  let r = Runs.of_text source in
  is_run "sensors" (Runs.check r)

(* Allocation looks where vehicles are, though no code of this program does. *)
let allocation_sees () =
  let source = "v = pick { type 'UUV' }\nexecute task('a')[v]\nexecute task('b')[v]" in
  let r = Runs.of_text ~period:1e9 source in
  is_run "allocation" (Runs.check r);
  let rec second_execution before = function
    | line :: lines -> (
        match Entry.of_string line, before with
        | Ok (Transition { step = { label = "execute"; _ }; index; _ }), Ok (Entry.Vehicle _) when index > 2 -> ()
        | entry, _ -> second_execution entry lines)
    | [] -> Alcotest.fail "nothing is told of the vehicle just before it gets its second task"
  in
  second_execution (Error "") (Runs.lines r.journal)

(* The changes of A that the lines have, one after the other, are A. *)
let allocations () =
  let module Names = Map.Make (String) in
  let go (r : Runs.t) =
    let line (replay, a) text =
      match Result.map (fun entry -> (entry, Replay.feed replay entry)) (Entry.of_string text) with
      | Ok (entry, Ok replay) ->
        let changes = match entry with Entry.Transition { step; _ } -> step.allocated | _ -> [] in
        let a = List.fold_left (fun a (v, task) -> Names.update v (fun _ -> task) a) a changes in
        let all = (Replay.configuration replay).shared.allocation in
        let named = List.map (fun (v, (p : Core.platform_task)) -> (v, p.name)) (Vehicle_map.bindings all) in
        Alcotest.(check (list (pair string string))) (r.name ^ ": " ^ text) named (Names.bindings a);
        (replay, a)
      | Ok (_, Error _) | Error _ -> Alcotest.failf "%s: %s" r.name text
    in
    ignore (List.fold_left line (Replay.start ~hash:r.hash r.program, Names.empty) (Runs.lines r.journal))
  in
  List.iter (fun name -> go (Runs.run ~period:60. name)) Runs.examples;
  go (Runs.of_text "v = pick { count 3; type 'UUV' }\nexecute (task('a')[v[0]] | task('b')[v[1]] | task('c')[v[2]]) during 1");
  go (Runs.of_text "v = pick { count 2; type 'UUV' }\nexecute (task('a')[v[0]] >> action { x = [1][1] }) | repeat task('b')[v[1]]")

let ends_of name source expected =
  let r = Runs.of_text source in
  match Runs.check r with
  | Run { ending; _ } -> Alcotest.(check string) name expected ending.how
  | verdict -> Alcotest.failf "%s: %s" name (show verdict)

let endings () =
  ends_of "completed" "message 1" "completed";
  ends_of "halted" "halt 'enough'" "halted";
  ends_of "failed" "x = [1][2]" "failed";
  ends_of "stuck" "v = pick { type 'UUV' }\nexecute waitFor { consume a: 1 } then task('t')[v]" "stuck"

(* Every kind of value that N may hold, and handlers that post. *)
let tuples () =
  let source =
    {|post a: 1, b: 'x', c: [1, 2.5, 'y'], d: [k: true], e: null
      consume a: _, c: _
      post a: 1; post a: 1; consume a: 1
      v = pick { type 'UUV' }
      execute (watch (action { post f: [1][7] }) onError { post error: 1; consume b: 'x'; ignore() }) >> task('t')[v]|}
  in
  let r = Runs.of_text source in
  is_run "tuples" (Runs.check r);
  let handled line =
    match Entry.of_string line with
    | Ok (Transition { step; _ }) -> step.posted = [ "error:1" ] && step.consumed = [ "b:'x'" ]
    | Ok _ | Error _ -> false
  in
  Alcotest.(check bool) "what a handler does to N is there" true (List.exists handled (Runs.lines r.journal))

(* A pick of many among many has more ways than can be tried. *)
let many_choices () =
  let vehicles = List.init 60 (Printf.sprintf "vehicle 'v%d', { type 'UUV' }") in
  match Dolphin_scenario.Scenario.read ~file:"many.fleet" (String.concat "\n" vehicles) with
  | Error _ -> Alcotest.fail "the fleet is wrong"
  | Ok scenario ->
    let r = Runs.of_scenario scenario "v = pick { count 30; type 'UUV' }\nmessage 1" in
    is_run "many" (Runs.check r);
    let other = Str.global_replace (Str.regexp_string "\"v29\"") "\"v59\"" r.journal in
    (match Runs.check_text r other with
     | No_run _ -> ()
     | verdict -> Alcotest.failf "other vehicles: %s" (show verdict))

(* Of transitions that look alike, [choice] selects the taken one. An event makes one only. *)
let choices () =
  let r = Runs.of_text "v = pick { type 'UUV' }\nexecute task('t')[v]" in
  let chosen label =
    Str.global_replace (Str.regexp (Printf.sprintf {|"label":"%s[^"]*"|} label)) {|\0,"choice":1|} r.journal
  in
  let is_refused label =
    match Runs.check_text r (chosen label) with
    | No_run _ -> ()
    | verdict -> Alcotest.failf "%s: %s" label (show verdict)
  in
  List.iter is_refused [ "start"; "done" ]

(* {1 Cut journals} *)

(* Cut anywhere it is the beginning of a run, or not a journal as long as it lacks a header. *)
let cut_everywhere () =
  let r = Runs.run ~period:60. "tuple_space" in
  let header = String.index r.journal '\n' in
  let check length =
    match Runs.check_text r (String.sub r.journal 0 length) with
    | Unreadable { number = 1; _ } when length < header -> ()
    | Prefix { torn; _ } when length >= header ->
      let between = r.journal.[length - 1] = '\n' || r.journal.[length] = '\n' in
      if torn = between then Alcotest.failf "cut at %d: torn is %b" length torn
    | Run _ when length = String.length r.journal - 1 -> ()
    | verdict -> Alcotest.failf "cut at %d: %s" length (show verdict)
  in
  for length = 0 to String.length r.journal - 1 do check length done

let refused () =
  let r = Runs.run "pause" in
  let expect why journal =
    match Runs.check_text r journal with
    | Unreadable found -> Alcotest.(check string) why why found.why
    | verdict -> Alcotest.failf "%s: %s" why (show verdict)
  in
  expect "the journal is empty" "";
  expect "this is not a journal: its first line is not the header of one" "{}\n";
  expect "this is not a journal: its first line is not the header of one" "[]\n";
  expect "this journal is of version 2; version 1 is known here" "{\"format\":\"dolphin-journal\",\"version\":2}\n";
  let header = List.hd (Runs.lines r.journal) in
  expect "a second header" (Runs.text [ header; header ]);
  expect "\"time\" is missing" (Runs.text [ header; "{\"kind\":\"event\"}" ]);
  expect "\"kind\" is 'wish', not one of vehicle, event, transition, label, platform, operator, resumed, end" (Runs.text [ header; "{\"kind\":\"wish\",\"time\":1}" ]);
  let deep = String.make 1_000_000 '[' in
  match Runs.check_text r (Runs.text [ header; deep ]) with
  | Unreadable { number = 2; _ } -> ()
  | verdict -> Alcotest.failf "deep: %s" (show verdict)

(* The order of vehicles is the header's: 'b' was heard of first. *)
let orders () =
  let scenario =
    let vehicle id = Printf.sprintf "vehicle '%s', { type 'UUV' }\n" id in
    match Dolphin_scenario.Scenario.read ~file:"two.fleet" (vehicle "b" ^ vehicle "a") with
    | Ok scenario -> scenario
    | Error _ -> Alcotest.fail "the fleet is wrong"
  in
  let r = Runs.of_scenario scenario "v = pick { count 2; timeout 1.second }\nmessage v[0].id" in
  is_run "by hearing" (Runs.check r);
  let by_id line =
    match Entry.of_string line with
    | Ok (Header h) -> Entry.to_string (Header { h with order = By_id })
    | Ok _ | Error _ -> line
  in
  let labels journal =
    List.filter_map
      (fun line -> match Entry.of_string line with Ok (Transition { step; _ }) -> Some step.label | _ -> None)
      (Runs.lines journal)
  in
  Alcotest.(check bool) "b is first" true (List.mem "bind(b, a)" (labels r.journal));
  match Runs.check_text r (Runs.text (List.map by_id (Runs.lines r.journal))) with
  | No_run { entry = Transition { step = { label; _ }; _ }; _ } ->
    Alcotest.(check string) "not by id" "bind(b, a)" label
  | verdict -> Alcotest.failf "by id: %s" (show verdict)

(* Earlier versions cancelled the timer that had just expired, where a handler ended the program in that step. *)
let earlier_ends () =
  let r = Runs.of_text "execute (watch (idle(100) within 5) onError { halt 'too late' }) | idle(30)" in
  is_run "as it is" (Runs.check r);
  let cancels = ref 0 in
  let earlier line =
    match Entry.of_string line with
    | Ok (Transition ({ step = { label = "timeout"; requests; _ } as step; _ } as t)) ->
      incr cancels;
      Entry.to_string (Transition { t with step = { step with requests = Request.Cancel_timer 1 :: requests } })
    | Ok _ | Error _ -> line
  in
  let before = Runs.text (List.map earlier (Runs.lines r.journal)) in
  Alcotest.(check int) "one end" 1 !cancels;
  is_run "as it was" (Runs.check_text r before);
  let lines = List.filter (fun line -> line <> "") (Runs.lines before) in
  let resumed_without n =
    match Runs.resume r (Runs.text (List.filteri (fun i _ -> i < List.length lines - n) lines)) with
    | Ok joined -> is_run "resumed" (Runs.check_text r joined)
    | Error why -> Alcotest.failf "resumed without its last %d lines: %s" n why
  in
  List.iter resumed_without [ 1; 2; 3 ];
  (* Other timers still have to be as the semantics has them. *)
  let wrong line =
    match Entry.of_string line with
    | Ok (Transition ({ step = { label = "timeout"; requests; _ } as step; _ } as t)) ->
      Entry.to_string (Transition { t with step = { step with requests = Request.Cancel_timer 7 :: requests } })
    | Ok _ | Error _ -> line
  in
  match Runs.check_text r (Runs.text (List.map wrong (Runs.lines r.journal))) with
  | No_run _ -> ()
  | verdict -> Alcotest.failf "a timer that never ran: %s" (show verdict)

let () =
  Alcotest.run "journals"
    [ ( "journals",
        [ case "those of all examples check" examples_check;
          case "lines are canonical" canonical;
          case "what programs read of sensors is there" sensors;
          case "what allocation reads is there" allocation_sees;
          case "the changes of A are A" allocations;
          case "all endings" endings;
          case "ends in journals of earlier versions" earlier_ends;
          case "all kinds of tuples" tuples;
          case "a pick of 30 among 60" many_choices;
          case "vehicles by hearing and by id" orders;
          case "a choice that was not there" choices;
          case "cut at every byte" cut_everywhere;
          case "what is no journal is refused" refused ] ) ]
