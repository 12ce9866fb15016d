open Dolphin_platform_protocol
open Dolphin_platform_process
open Dolphin_runtime
module D = Dispatch

(* {1 A dispatch, its time and its output} *)

type world = {
  mutable d : D.t;
  mutable now : float;
  mutable out : D.output list;  (* latest first *)
  mutable started : int;
}

let take_outputs w =
  let out = List.rev w.out in
  w.out <- [];
  out

let step w f =
  let d, out = f ~now:w.now w.d in
  w.d <- d;
  w.out <- List.rev_append out w.out;
  (* The disk is quick here. *)
  List.iter
    (function
      | D.Keep_before (_, _, request) ->
        let d, out = D.durable ~now:w.now request w.d in
        w.d <- d;
        w.out <- List.rev_append out w.out
      | Send _ | Keep _ | Keep_and_tell _ | Remark _ | Give_up _ -> ())
    out

let report w r = step w (fun ~now d -> D.report ~now r d)
let greeting = { Report.version = 1; name = "x"; adapter = None; plans = [ "name" ]; announce = 1.; patience = 10. }
let born w = step w (fun ~now d -> D.born ~now greeting d)
let died w = step w (fun ~now d -> D.died ~now d)
let start w v name =
  w.started <- w.started + 1;
  step w (fun ~now d -> D.start ~now ~number:w.started v { name; plan = None; task_site = 0 } d)
let stop w v = step w (fun ~now d -> D.stop ~now v d)

(* Time passes, and whatever is due happens when it is; pings are answered. *)
let pass w seconds =
  let until = w.now +. seconds in
  let rec go () =
    let due = D.due w.d in
    if due <= until then begin
      w.now <- Float.max w.now due;
      step w (fun ~now d -> D.tick ~now d);
      report w (Pong 0);
      go ()
    end
  in
  go ();
  w.now <- until

let sight ?(link = true) ?unready v =
  Report.Vehicle
    { (Report.nothing v) with
      kind = Some "UUV"; place = Some (41., -8.); link = Some link; unready = Some unready }

(* Requests are numbered behind [prefix]. *)
let empty prefix = D.create ~platform:"x" ~identity:(fun ~number _ _ -> Printf.sprintf "%s-%d" prefix number)

let fresh () =
  let w = { d = empty "r"; now = 0.; out = []; started = 0 } in
  born w;
  report w (sight "v");
  ignore (take_outputs w);
  w

let shown = function
  | D.Send order -> (
      match order with
      | Start { request; vehicle; plan; _ } ->
        let name = match plan with `Assoc (("name", `String name) :: _) -> name | _ -> "?" in
        Some (Printf.sprintf "start %s %s %s" request vehicle name)
      | Stop { request; vehicle } -> Some (Printf.sprintf "stop %s %s" request vehicle)
      | Resume { request; vehicle; notes; doubt; _ } ->
        let doubt =
          match doubt with None -> "" | Some Lost_order -> ", and its order?" | Some Lost_notes -> ", and its notes?" in
        Some (Printf.sprintf "resume %s %s %s%s" request vehicle (Yojson.Safe.to_string (`List notes)) doubt)
      | Kept id -> Some (Printf.sprintf "kept %d" id)
      | Refused why -> Some ("refused: " ^ why)
      | Hello _ | Telemetry _ | Hold _ | Release _ | Timeout _ | Ping _ | Check _ | Close -> None)
  | Remark (v, text) -> Some (Printf.sprintf "remark %s: %s" (Option.value v ~default:"-") text)
  | Give_up why -> Some ("give up: " ^ why)
  | Keep _ | Keep_before _ | Keep_and_tell _ -> None

let rec events w =
  match D.take w.d with
  | None -> []
  | Some (event, d) ->
    w.d <- d;
    let text =
      match event with
      | Platform.Vehicle { id; connected; unready; _ } ->
        Printf.sprintf "%s %s" id
          (match connected, unready with false, _ -> "lost" | true, None -> "ready" | true, Some why -> why)
      | Task_done v -> v ^ " done"
      | Task_failed (v, why) -> Printf.sprintf "%s failed: %s" v why
      | Timer timer -> Printf.sprintf "timer %d" timer
      | Input (k, _) -> "input " ^ k
      | Quiet -> "quiet"
    in
    text :: events w

let check_out w what expected =
  Alcotest.(check (list string)) what expected (List.filter_map shown (take_outputs w))

let check_events w what expected = Alcotest.(check (list string)) what expected (events w)

(* {1 Tests} *)

let completion () =
  let w = fresh () in
  check_events w "the vehicle is there" [ "v ready" ];
  start w "v" "p";
  check_out w "ordered" [ "start r-1 v p" ];
  report w (Request ("r-1", Taken));
  report w (Request ("r-1", Done));
  report w (Request ("r-1", Done));
  report w (Request ("r-1", Failed "late"));
  check_events w "one end" [ "v done" ];
  Alcotest.(check bool) "quiet" true (D.quiet w.d)

let measurements () =
  let w = fresh () in
  ignore (events w);
  w.d <- fst (D.telemetry true w.d);
  let readings () =
    match D.take w.d with
    | Some (Platform.Vehicle { readings; speed; _ }, d) ->
      w.d <- d;
      (readings, speed)
    | Some _ | None -> Alcotest.fail "nothing is told"
  in
  let measured = Alcotest.(pair (list (pair string (float 0.))) (option (float 0.))) in
  let tell speed readings = report w (Vehicle { (Report.nothing "v") with speed; readings }) in
  tell (Some (Some 1.5)) [ ("Temperature", Some 14.); ("Depth", Some 3.) ];
  Alcotest.check measured "all of them, in order" ([ ("Depth", 3.); ("Temperature", 14.) ], Some 1.5) (readings ());
  tell None [ ("Temperature", Some 13.) ];
  Alcotest.check measured "the others are as before" ([ ("Depth", 3.); ("Temperature", 13.) ], Some 1.5) (readings ());
  tell (Some None) [ ("Depth", None) ];
  Alcotest.check measured "not known any more" ([ ("Temperature", 13.) ], None) (readings ())

let refusals () =
  let w = fresh () in
  let refused why = step w (fun ~now d -> D.refused ~now why d) in
  let ignored why = Printf.sprintf "a line of the adapter %s; it is ignored" why in
  refused "a";
  check_out w "the adapter is informed at once" [ "refused: a"; "remark -: " ^ ignored "a" ];
  pass w 0.5;
  List.iter (fun n -> refused (string_of_int n)) [ 1; 2; 3 ];
  check_out w "not each time" [];
  pass w 0.4;
  check_out w "not yet" [];
  pass w 0.2;
  check_out w "of the last one" [ "refused: 3"; "remark -: 3 more lines are ignored; of the last one: " ^ ignored "3" ];
  pass w 3.;
  check_out w "once" [];
  report w (Vehicle { (Report.nothing "new") with link = Some true });
  let why = "the first report of new has no type" in
  check_out w "a report that cannot be used" [ "refused: " ^ why; "remark -: " ^ why ^ ": it is ignored" ];
  refused "b";
  died w;
  born w;
  pass w 3.;
  check_out w "another adapter is not informed of it" [ "remark -: " ^ ignored "b" ];
  List.iter refused [ "c"; "d"; "e" ];
  check_out w "the first one at once" [ "refused: c"; "remark -: " ^ ignored "c" ];
  step w (fun ~now:_ d -> D.last_refusals d);
  check_out w "the number at the end" [ "remark -: 2 more lines are ignored; of the last one: " ^ ignored "e" ];
  pass w 3.;
  check_out w "once" []

(* A flood of lines is reported about once a second, and no line is left out of the count. *)
let flood =
  let counted text =
    match Scanf.sscanf text "remark -: %d more" Fun.id with
    | n -> n
    | exception Scanf.Scan_failure _ -> if String.length text > 6 && String.sub text 0 6 = "remark" then 1 else 0
  in
  let holds gaps =
    let w = fresh () in
    List.iter (fun gap -> pass w gap;
                step w (fun ~now d -> D.refused ~now "x" d)) gaps;
    step w (fun ~now:_ d -> D.last_refusals d);
    let counts = List.filter (fun n -> n > 0) (List.map counted (List.filter_map shown (take_outputs w))) in
    let span = List.fold_left ( +. ) 0. gaps in
    List.fold_left ( + ) 0 counts = List.length gaps && float_of_int (List.length counts) <= span +. 2.
  in
  Test_support.Property.case ~count:300 "each line that is refused is counted, once a second"
    ~print:QCheck2.Print.(list float)
    QCheck2.Gen.(list_size (int_bound 50) (float_bound_inclusive 0.3))
    holds

let both_or_neither =
  let members (latitude, longitude) =
    let one name = function Some x -> [ (name, `Float x) ] | None -> [] in
    one "latitude" latitude @ one "longitude" longitude
  in
  let line place =
    Yojson.Safe.to_string (`Assoc (("kind", `String "vehicle") :: ("vehicle", `String "v") :: members place)) in
  Test_support.Property.case ~count:300 "latitude and longitude: both or neither" ~print:line
    QCheck2.Gen.(pair (opt (float_range (-90.) 90.)) (opt (float_range (-180.) 180.)))
    (fun place ->
       match Report.of_line (line place), place with
       | Ok (Some (Vehicle { place = Some found; _ })), (Some a, Some b) -> found = (a, b)
       | Ok (Some (Vehicle { place = None; _ })), (None, None) -> true
       | Error _, ((Some _, None) | (None, Some _)) -> true
       | _, _ -> false)

let stop_then_start () =
  let w = fresh () in
  start w "v" "p";
  report w (Request ("r-1", Taken));
  stop w "v";
  start w "v" "q";
  check_out w "the next start waits for the end" [ "start r-1 v p"; "stop r-1 v" ];
  report w (Request ("r-1", Stopped));
  check_out w "and comes then" [ "start r-2 v q" ];
  ignore (events w);
  report w (Request ("r-2", Done));
  check_events w "only the second is told" [ "v done" ]

let prepared_end () =
  let w = fresh () in
  ignore (events w);
  start w "v" "p";
  report w (Request ("r-1", Done));
  stop w "v";
  check_events w "no event follows a stop" []

let not_yet_durable () =
  let w = fresh () in
  ignore (events w);
  (* Without the disk's word nothing is ordered, and a stop needs no order either. *)
  let d, _ = D.start ~now:0. ~number:1 "v" { name = "p"; plan = None; task_site = 0 } w.d in
  w.d <- d;
  stop w "v";
  let d, out = D.durable ~now:0. "r-1" w.d in
  w.d <- d;
  Alcotest.(check int) "nothing is sent" 0 (List.length out);
  check_out w "nor a stop" [];
  Alcotest.(check bool) "quiet" true (D.quiet w.d)

let silence () =
  let w = fresh () in
  ignore (events w);
  start w "v" "p";
  report w (Request ("r-1", Taken));
  report w (sight ~link:false "v");
  pass w 59.;
  check_events w "not yet" [ "v lost" ];
  pass w 2.;
  check_events w "too long" [ "v failed: no word from the vehicle for 60 seconds" ];
  check_out w "it is to stop" [ "start r-1 v p"; "stop r-1 v" ];
  Alcotest.(check (list (pair string string))) "may still run" [ ("v", "p") ] (D.unsettled w.d)

let link_returns () =
  let w = fresh () in
  ignore (events w);
  start w "v" "p";
  report w (Request ("r-1", Taken));
  report w (sight ~link:false "v");
  pass w 50.;
  report w (sight "v");
  report w (sight ~link:false "v");
  pass w 50.;
  check_events w "counted anew" [ "v lost" ];
  report w (sight "v");
  report w (Request ("r-1", Done));
  check_events w "as if nothing had happened" [ "v ready"; "v done" ]

let no_answer () =
  let w = fresh () in
  ignore (events w);
  start w "v" "p";
  pass w 9.;
  check_events w "not yet" [];
  pass w 2.;
  check_events w "the patience of the greeting" [ "v failed: no answer to the order to start for 10 seconds" ];
  check_out w "stopped" [ "start r-1 v p"; "stop r-1 v" ]

let stop_without_answer () =
  let w = fresh () in
  ignore (events w);
  start w "v" "p";
  report w (Request ("r-1", Taken));
  stop w "v";
  start w "v" "q";
  ignore (take_outputs w);
  pass w 61.;
  check_out w "given up, told, and the next one ordered"
    [ "remark v: may still run plan p: the stop has had no answer for 60 seconds"; "start r-2 v q" ];
  report w (Request ("r-2", Done));
  Alcotest.(check (list (pair string string))) "named at the end" [ ("v", "p") ] (D.unsettled w.d);
  report w (Request ("r-1", Stopped));
  Alcotest.(check (list (pair string string))) "until it is certain" [] (D.unsettled w.d)

let unknown () =
  let w = fresh () in
  ignore (events w);
  start w "v" "p";
  ignore (take_outputs w);
  report w (Request ("r-1", Unknown "no answer to the upload"));
  report w (Request ("r-1", Unknown "no answer to the upload"));
  check_events w "failed once" [ "v failed: no answer to the upload" ];
  check_out w "and stopped" [ "stop r-1 v" ];
  report w (Request ("r-1", Done));
  check_events w "what it did does not matter" [];
  Alcotest.(check bool) "quiet" true (D.quiet w.d)

let death () =
  let w = fresh () in
  ignore (events w);
  start w "v" "p";
  report w (Request ("r-1", Taken));
  report w (Note { request = "r-1"; note = `Assoc [ ("a", `Int 1) ]; id = None });
  report w (Note { request = "r-1"; note = `Assoc [ ("b", `Int 2) ]; id = None });
  ignore (take_outputs w);
  died w;
  check_events w "its vehicles lose their link" [ "v lost" ];
  stop w "v";
  check_out w "nobody is there to be told" [];
  start w "v" "q";
  born w;
  check_out w "asked, with its notes, and stopped" [ "resume r-1 v [{\"b\":2},{\"a\":1}]"; "stop r-1 v" ];
  report w (sight "v");
  report w (Request ("r-1", Absent));
  check_out w "absent is an end, where it was to be stopped" [ "start r-2 v q" ];
  check_events w "it is back" [ "v ready" ]

let death_and_absent () =
  let w = fresh () in
  ignore (events w);
  start w "v" "p";
  died w;
  born w;
  ignore (take_outputs w);
  report w (Request ("r-1", Absent));
  check_out w "ordered again, as the same request" [ "start r-1 v p" ]

let death_for_long () =
  let w = fresh () in
  start w "v" "p";
  report w (Request ("r-1", Taken));
  ignore (events w);
  died w;
  pass w 61.;
  check_events w "the connection timeout counts" [ "v lost"; "v failed: no word from the vehicle for 60 seconds" ]

let start_while_dead () =
  let w = fresh () in
  ignore (events w);
  died w;
  start w "v" "p";
  check_out w "nothing is sent" [];
  born w;
  check_out w "it was never ordered: it is ordered now" [ "start r-1 v p" ]

let silent_adapter () =
  let w = fresh () in
  let rec go n =
    if n > 0 then begin
      w.now <- D.due w.d;
      step w (fun ~now d -> D.tick ~now d);
      go (n - 1)
    end
  in
  go 4;
  check_out w "three pings without a word" [ "give up: it has sent nothing for 15 seconds" ]

let strangers () =
  let w = { d = empty "r"; now = 0.; out = []; started = 0 } in
  born w;
  report w (Vehicle { (Report.nothing "v") with link = Some true });
  report w (Request ("nobody's", Done));
  check_out w "told" [ "refused: the first report of v has no type"; "remark -: the first report of v has no type: it is ignored" ];
  report w (Vehicle { (Report.nothing "v") with link = Some true; kind = Some "UAV" });
  check_events w "no program sees it without a position" [];
  report w (Vehicle { (Report.nothing "v") with place = Some (1., 2.); unready = Some (Some "is on the ground") });
  check_events w "now it does" [ "v is on the ground" ]

(* {2 Resumption} *)

let asked plan request : Yojson.Safe.t =
  `Assoc [ ("platform", `String "x"); ("asked", `String plan); ("request", `String request) ]

let note kind request : Yojson.Safe.t = `Assoc [ ("platform", `String "x"); (kind, `String request) ]
let task name : Dolphin_semantics.Core.platform_task = { name; plan = None; task_site = 0 }
let entry what : History.entry = { time = 1.; what }

let resumed history =
  let d = D.resume ~now:100. ~announce_period:1. (List.map entry history) (empty "s") in
  let w = { d; now = 100.; out = []; started = 10 } in
  born w;
  w

let effects number effects : History.what = Asked { number; effects }
let started number name = effects number [ Start ("v", task name) ]
let start_p = started 1 "p"
let stop_v = effects 2 [ Stop "v" ]
let noted json : History.what = Noted ("v", json)

let resume_cases () =
  let check what history expected =
    let w = resumed history in
    step w (fun ~now d -> D.tick ~now d);
    (* The data of a new request is durable at once. *)
    check_out w what expected
  in
  check "asked: what became of it?" [ start_p; noted (asked "p" "r-1") ] [ "resume r-1 v [], and its notes?" ];
  check "asked and stopped" [ start_p; noted (asked "p" "r-1"); stop_v ] [ "resume r-1 v [], and its notes?"; "stop r-1 v" ];
  check "stopped, and that was confirmed" [ start_p; noted (asked "p" "r-1"); stop_v; noted (note "over" "r-1") ] [];
  check "ended" [ start_p; noted (asked "p" "r-1"); Happened (Vehicle_done "v") ] [];
  check "no note of it: the adapter is asked" [ start_p ] [ "resume s-1 v [], and its order?" ];
  check "never asked, and not wanted" [ start_p; stop_v ] [];
  check "the stop of the one before is not confirmed"
    [ start_p; noted (asked "p" "r-1"); stop_v; started 3 "q" ]
    [ "resume r-1 v [], and its notes?"; "stop r-1 v" ];
  check "it is confirmed"
    [ start_p; noted (asked "p" "r-1"); stop_v; started 3 "q"; noted (note "over" "r-1") ]
    [ "resume s-3 v [], and its order?" ];
  check "no note of a plan that ran before"
    [ start_p; noted (asked "p" "r-1"); Happened (Vehicle_done "v"); started 3 "p" ]
    [ "resume s-3 v []" ];
  check "no notes on a plan that ran before"
    [ start_p; noted (asked "p" "r-1"); Happened (Vehicle_done "v"); started 3 "p"; noted (asked "p" "r-3") ]
    [ "resume r-3 v []" ];
  check "a task that failed, and may still run"
    [ start_p; noted (asked "p" "r-1");
      noted
        (`Assoc
           [ ("platform", `String "x"); ("unsettled", `String "r-1"); ("plan", `Assoc [ ("name", `String "p") ]) ]);
      Happened (Vehicle_failed ("v", "silence")) ]
    [ "resume r-1 v []"; "stop r-1 v" ]

(* A start without a note in the journal, whose end may be lost: only the adapter knows of it. *)
let unnoted_cases () =
  let asks_about history =
    let w = resumed history in
    report w (sight "v");
    check_out w "it is asked about" [ "resume s-1 v [], and its order?" ];
    ignore (events w);
    w
  in
  let say w word = report w (Request ("s-1", word)) in
  let w = asks_about [ start_p ] in
  say w Absent;
  check_out w "never started: it is ordered" [ "start s-1 v p" ];
  say w Taken;
  say w Done;
  check_events w "and ends" [ "v done" ];
  let w = asks_about [ start_p ] in
  say w Taken;
  say w Done;
  check_out w "it runs: nothing is ordered" [];
  check_events w "it ends" [ "v done" ];
  let w = asks_about [ start_p ] in
  say w (Unknown "who knows");
  check_out w "uncertain: it is stopped" [ "stop s-1 v" ];
  check_events w "and has failed" [ "v failed: who knows" ];
  let w = asks_about [ start_p ] in
  stop w "v";
  check_out w "not wanted any more: it is stopped" [ "stop s-1 v" ];
  let w = asks_about [ start_p ] in
  died w;
  ignore (take_outputs w);
  born w;
  check_out w "the adapter dies: its successor is asked" [ "resume s-1 v [], and its order?" ];
  let w = resumed [ started 7 "o"; noted (asked "o" "r-7"); stop_v; start_p ] in
  report w (sight "v");
  check_out w "the one before is to be stopped first" [ "resume r-7 v [], and its notes?"; "stop r-7 v" ];
  report w (Request ("r-7", Stopped));
  check_out w "then it is asked about" [ "resume s-1 v [], and its order?" ];
  say w Absent;
  check_out w "and ordered" [ "start s-1 v p" ]

(* The order waits for the disk. *)
let unnoted_and_durable () =
  let w = resumed [ start_p ] in
  ignore (take_outputs w);
  let d, outputs = D.report ~now:w.now (Request ("s-1", Absent)) w.d in
  let is_start = function D.Send (Start _) -> true | _ -> false in
  Alcotest.(check bool) "no start before its note" false (List.exists is_start outputs);
  let waits = List.exists (function D.Keep_before (_, _, "s-1") -> true | _ -> false) outputs in
  Alcotest.(check bool) "it is kept first" true waits;
  let _, outputs = D.durable ~now:w.now "s-1" d in
  Alcotest.(check bool) "then it starts" true (List.exists is_start outputs)

(* {2 At random} *)

(* However reports come, each start that is not stopped has one end, and none that was stopped has. *)
type action = Start | Stop | Word of string * Report.word | Die | Pass of float | Link of bool

let actions =
  let open QCheck2.Gen in
  let request = map (Printf.sprintf "r-%d") (int_range 1 6) in
  let word =
    oneofl
      [ Report.Taken; Done; Failed "no"; Stopped; Unknown "who knows"; Absent;
        Progress { share = Some 0.5; remaining = None } ]
  in
  let action =
    frequency
      [ (3, return Start); (2, return Stop); (8, map2 (fun r w -> Word (r, w)) request word); (1, return Die);
        (2, map (fun s -> Pass s) (float_range 0. 70.)); (2, map (fun link -> Link link) bool) ]
  in
  list_size (int_range 1 40) action

let print_action = function
  | Start -> "start"
  | Stop -> "stop"
  | Word (r, word) -> Yojson.Safe.to_string (Report.to_json (Request (r, word)))
  | Die -> "die or be born"
  | Pass s -> Printf.sprintf "pass %g" s
  | Link on -> Printf.sprintf "link %b" on

let is_end event = event = "v done" || (String.length event > 8 && String.sub event 0 8 = "v failed")

let one_end_each actions =
  let w = fresh () in
  let running = ref false and is_alive = ref true in
  (* Whether at most one end was reported, for a running task. *)
  let see () =
    match List.filter is_end (events w) with
    | [] -> true
    | [ _ ] when !running -> running := false; true
    | _ -> false
  in
  let act = function
    | Start -> if not !running then begin start w "v" "p"; running := true end
    | Stop -> stop w "v"; running := false
    | Word (r, word) -> report w (Request (r, word))
    | Die -> (if !is_alive then died w else born w); is_alive := not !is_alive
    | Pass s -> pass w s
    | Link link -> report w (sight ~link "v")
  in
  let one action = act action; see () in
  let all_but_the_last = List.for_all one actions in
  (* After a silence that is long enough nothing is owed. *)
  report w (sight ~link:false "v");
  pass w 200.;
  all_but_the_last && see () && not !running

let random =
  Test_support.Property.case ~count:3000 "each start has one end, unless it is stopped"
    ~print:(fun actions -> String.concat "; " (List.map print_action actions))
    actions one_end_each

let case name f = Alcotest.test_case name `Quick f

let () =
  Alcotest.run "platform_process"
    [ ( "dispatch",
        [ case "a plan runs to its end, which is told once" completion;
          case "what a vehicle measures" measurements; case "a start waits for a stop" stop_then_start;
          case "a stop takes back an end that waits to be told" prepared_end;
          case "nothing is ordered before the disk has it" not_yet_durable;
          case "a link that is lost for too long" silence; case "a link that returns" link_returns;
          case "a start without an answer" no_answer; case "a stop without an answer" stop_without_answer;
          case "what is not certain" unknown; case "a vehicle without type or position" strangers;
          case "a line that is refused" refusals; flood; both_or_neither ] );
      ( "deaths",
        [ case "the adapter dies, and is asked" death; case "what never reached it is ordered again" death_and_absent;
          case "it is dead for long" death_for_long; case "a start meanwhile" start_while_dead;
          case "it is silent" silent_adapter ] );
      ( "resumption",
        [ case "what the journal says" resume_cases; case "a start without a note" unnoted_cases;
          case "a start without a note waits for the disk" unnoted_and_durable ] );
      ("random", [ random ]) ]
