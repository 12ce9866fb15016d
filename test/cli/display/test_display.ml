open Dolphin_semantics
open Dolphin_display
module Phrase = Dolphin_trace.Phrase

let case name f = Alcotest.test_case name `Quick f
let text = Alcotest.(check string)
let lines = Alcotest.(check (list string))

(* {1 Words} *)

let clocks () =
  List.iter
    (fun (seconds, expected) -> text expected expected (Phrase.time seconds))
    [ (0., "0:00"); (59.4, "0:59"); (59.999_999_9, "1:00"); (540., "9:00"); (3600., "1:00:00"); (90_061., "25:01:01") ]

let durations () =
  List.iter
    (fun (seconds, expected) -> text expected expected (Wording.duration seconds))
    [ (0., "0 s"); (0.5, "0.5 s"); (90., "1.5 min"); (7200., "2 h"); (3661., "1 h 1 min 1 s");
      (1234567.5, "342 h 56.125 min") ]

let harmless () =
  text "an escape sequence" "a?[31mb" (Phrase.harmless "a\027[31mb");
  text "one in UTF-8" "a?31m" (Phrase.harmless "a\xC2\x9B31m");
  text "lines and letters stay" "é\nß" (Phrase.harmless "é\nß");
  text "a tab takes one column" "a b" (Phrase.harmless "a\tb");
  text "one line" "a b?" (Phrase.one_line "a\nb\r")

let many_vehicles () =
  text "few are named" "a, b" (Wording.vehicles [ "a"; "b" ]);
  text "of many the first" "v0, v1, v2, v3, v4, v5, v6, v7 and 992 more"
    (Wording.vehicles (List.init 1000 (Printf.sprintf "v%d")))

(* {1 The log and the board} *)

let task name : Core.platform_task = { name; plan = None; task_site = 0 }

let configuration bound running : Configuration.t =
  {
    control = Ended Completed;
    shared =
      {
        store = Store.empty;
        allocation = Vehicle_map.of_seq (List.to_seq running);
        bound;
        tuples = Tuples.empty Tuple_space.no_key;
      };
  }

let transition ?(rules = []) ?(effects = []) ?(running = []) ?(bound = []) label : Transition.t =
  { rules; label; next = configuration bound running; effects; assumed = []; otherwise = [] }

let told ts =
  let tell (log, reversed) (time, t) =
    let log, lines = Log.transition log ~time t in
    (log, List.rev_append (List.map (fun (l : Log.line) -> l.text) lines) reversed)
  in
  List.rev (snd (List.fold_left tell (Log.start, []) ts))

let log_of_a_task () =
  let bound = [ "v" ] and p = task "dive" in
  lines "start, end"
    [ "   0:00  program     picks v"; "   0:00  v           starts dive"; "   1:00  v           ends dive" ]
    (told
       [ (0., transition ~bound ~effects:[ Bind bound ] (Bind bound));
         (0., transition ~bound ~running:[ ("v", p) ] ~effects:[ Start ("v", p) ] (Start ("v", "dive")));
         (60., transition ~bound (Done ("v", "dive"))) ])

let log_of_a_stop () =
  let bound = [ "v" ] and p = task "dive" in
  lines "what is stopped has its name"
    [ "   0:00  v           starts dive"; "   0:05  v           stops dive"; "   0:05  program     releases v";
      "   0:05  program     is interrupted" ]
    (told
       [ (0., transition ~bound ~running:[ ("v", p) ] ~effects:[ Start ("v", p) ] (Start ("v", "dive")));
         (5., transition ~effects:[ Stop "v"; Release bound; End Interrupted ] Interrupt) ])

(* Vehicles of a network choose their names. *)
let log_of_strange_names () =
  let bound = [ "v\n1" ] and p = task "dive\n\027[2J" in
  lines "a line for each event"
    [ "   0:00  program     picks v 1"; "   0:00  v 1         starts dive ?[2J"; "   1:00  v 1         ends dive ?[2J" ]
    (told
       [ (0., transition ~bound ~effects:[ Bind bound ] (Bind bound));
         (0., transition ~bound ~running:[ ("v\n1", p) ] ~effects:[ Start ("v\n1", p) ] (Start ("v\n1", p.name)));
         (60., transition ~bound (Done ("v\n1", p.name))) ])

let log_of_deeds () =
  let deeds : Code.deed list = [ Posted [ ("k", Integer 1) ]; Said "two\nlines"; Posted [ ("l", Integer 2) ] ] in
  lines "in their order, once each"
    [ "   0:00  program     posts k:1"; "   0:00  program     says: two\n                     lines";
      "   0:00  program     posts l:2" ]
    (told [ (0., transition ~effects:[ Say "two\nlines" ] (Act deeds)) ])

let state ?(connected = true) ?unready id : World.vehicle_state =
  { id; kind = "UUV"; payload = []; position = { latitude = 41.; longitude = -8.; height = 0. }; battery = Some 0.5;
    depth = None; altitude = None; speed = Some 0.; readings = []; connected; unready; cruise = None;
    drain = None; progress = [] }

let news log ~time state =
  let log, lines = Log.news log ~time state in
  (log, List.map (fun (l : Log.line) -> l.text) lines)

let log_of_links () =
  let log, _ = Log.transition Log.start ~time:0. (transition ~bound:[ "v" ] (Bind [ "v" ])) in
  let log, lost = news log ~time:1. (state ~connected:false "v") in
  let log, still = news log ~time:2. (state ~connected:false "v") in
  let log, back = news log ~time:3. (state "v") in
  let _, of_others = news log ~time:4. (state ~connected:false "w") in
  lines "lost" [ "   0:01  v           loses its link" ] lost;
  lines "told once" [] still;
  lines "back" [ "   0:03  v           has its link back" ] back;
  lines "only of the program's vehicles" [] of_others

let log_of_readiness () =
  let log, _ = Log.transition Log.start ~time:0. (transition ~bound:[ "v" ] (Bind [ "v" ])) in
  let log, unready = news log ~time:1. (state ~unready:"is in mode ERROR: leak" "v") in
  let log, still = news log ~time:2. (state ~unready:"is in mode ERROR: leak" "v") in
  let log, lost = news log ~time:3. (state ~connected:false "v") in
  let log, heard = news log ~time:4. (state ~unready:"is in mode ERROR: leak" "v") in
  let _, ready = news log ~time:5. (state "v") in
  lines "a link is something else" [ "   0:01  v           is in mode ERROR: leak" ] unready;
  lines "told once" [] still;
  lines "lost" [ "   0:03  v           loses its link" ] lost;
  lines "as before" [ "   0:04  v           has its link back" ] heard;
  lines "ready" [ "   0:05  v           is ready again" ] ready

let show ?(now = 75.) ?(waiting = []) ?(rows = 20) ?(columns = 80) b =
  Status.lines b ~now ~estimate:(fun _ -> None) ~waiting ~rows ~columns ~colour:false

let board () =
  let bound = [ "v"; "w" ] and p = task "dive" in
  let b = Status.transition Status.start ~time:0. (transition ~bound ~effects:[ Bind bound ] (Bind bound)) in
  let b =
    Status.transition b ~time:10.
      (transition ~bound ~running:[ ("v", p) ] ~effects:[ Start ("v", p) ] (Start ("v", "dive")))
  in
  let b = Status.news b (state "v") in
  lines "a line for each vehicle"
    [ "   1:15  2 vehicles, 1 busy"; "         v  dive  1:05  50%  41.00000, -8.00000";
      "         w  -                                  " ]
    (show b);
  let b = Status.news b (state ~connected:false "w") in
  lines "trouble first"
    [ "   1:15  2 vehicles, 1 busy, 1 with trouble"; "         w  -           no link  41.00000, -8.00000";
      "         v  dive  1:05  50%      41.00000, -8.00000" ]
    (show b);
  lines "no wider than the terminal"
    [ "   1:15  2 vehicles, "; "         w  -        "; "         v  dive  1:0" ]
    (show ~columns:21 b);
  lines "no vehicle, no line" [] (show Status.start)

let failed_task () =
  let bound = [ "v" ] and p = task "dive" in
  let b =
    List.fold_left
      (fun b t -> Status.transition b ~time:0. t)
      Status.start
      [ transition ~bound ~running:[ ("v", p) ] ~effects:[ Start ("v", p) ] (Start ("v", "dive"));
        transition ~bound (Fail ("v", "dive", "leak")) ]
  in
  lines "a failed task stays until another one starts"
    [ "   1:15  1 vehicle, 0 busy, 1 with trouble"; "         v  failed in dive: leak      " ]
    (show b)

let waits () =
  let waiting : Waiting.t list =
    [ { what = "consume(go: 1) && battery(v) > 0.3"; at = None; lacking = Some "not yet battery(v) > 0.3" };
      { what = "an answer"; at = None; lacking = None } ]
  in
  lines "with what is lacking"
    [ "   1:15  0 vehicles, 0 busy";
      "         waits for consume(go: 1) && battery(v) > 0.3: not yet battery(v) > 0.3";
      "         waits for an answer" ]
    (show ~waiting Status.start);
  lines "on a narrow terminal"
    [ "   1:15  0 vehicles, 0 busy"; "         waits for consume(go: 1) &..."; "           not yet battery(v) > 0.3";
      "         waits for an answer" ]
    (show ~columns:38 ~waiting Status.start);
  lines "not all, if there is no room"
    [ "   1:15  0 vehicles, 0 busy"; "         and waits for 2 more" ]
    (show ~rows:6 ~waiting Status.start)

(* The board of a waiting program, by the program's own text. *)
let guards () =
  let source = "x = 1\nexecute condition { poll(a: 1)\n  && x > 2 }" in
  let program =
    match Dolphin_syntax.Parse.program ~file:"m.dol" source with
    | Error _ -> Alcotest.fail "it does not parse"
    | Ok ast -> (
        match Elaborate.program ~source_name:"m.dol" ast with
        | Ok (program, _) -> program
        | Error _ -> Alcotest.fail "it does not elaborate")
  in
  let rec wait (c : Configuration.t) =
    match Transition.internal program World.empty c () with Seq.Cons (t, _) -> wait t.next | Nil -> c in
  let c = wait (Configuration.initial program) in
  let of_pairs pairs : Configuration.t =
    let tuples = List.fold_left (fun n (k, x) -> Tuples.post k x n) c.shared.tuples pairs in
    { c with shared = { c.shared with tuples } }
  in
  let told c = List.map (fun (w : Waiting.t) -> (w.what, w.lacking)) (Waiting.list program ~source World.empty c) in
  let what = "poll(a: 1) && x > 2" in
  Alcotest.(check (list (pair string (option string)))) "nothing holds" [ (what, Some "not yet poll(a: 1)") ] (told c);
  Alcotest.(check (list (pair string (option string)))) "the first part holds" [ (what, Some "not yet x > 2") ]
    (told (of_pairs [ ("a", Core.Integer 1) ]))

let large_board () =
  let bound = List.init 1000 (Printf.sprintf "v%d") in
  let b = Status.transition Status.start ~time:0. (transition ~bound (Bind bound)) in
  let shown = show ~rows:14 b in
  Alcotest.(check int) "fills the height" 14 (List.length shown);
  text "and says how many are hidden" "         and 988 more" (List.nth shown 13)

(* {1 Filters and the end} *)

let filters () =
  let of_news = Log.news (fst (Log.transition Log.start ~time:0. (transition ~bound:[ "v" ] (Bind [ "v" ])))) in
  let lost = List.hd (snd (of_news ~time:1. (state ~connected:false "v"))) in
  let of_deed d = List.hd (snd (Log.transition Log.start ~time:0. (transition (Act [ d ])))) in
  let posted = of_deed (Posted [ ("k", Integer 1) ]) and said = of_deed (Said "hello") in
  let is_shown quiet only line = Log.is_shown ~quiet ~only line in
  Alcotest.(check (list bool)) "quiet" [ true; false; true ] (List.map (is_shown true []) [ lost; posted; said ]);
  Alcotest.(check (list bool)) "of one vehicle" [ true; false; false ]
    (List.map (is_shown false [ "w" ]) [ lost; posted; said ])

let summary () =
  let bound = [ "v" ] and p = task "dive" in
  let o =
    List.fold_left
      (fun o (time, t) -> Run_summary.transition o ~time t)
      Run_summary.start
      [ (0., transition ~bound ~effects:[ Start ("v", p) ] (Start ("v", "dive"))); (60., transition ~bound (Done ("v", "dive")));
        (60., transition ~bound ~effects:[ Start ("v", p) ] (Start ("v", "dive")));
        (61., transition ~bound (Fail ("v", "dive", "leak"))); (61., transition ~effects:[ End (Halted "") ] (Halt "")) ]
  in
  lines "what ran, what failed, where the journal is"
    [ "halted after 1:01"; "  tasks    1 done, 1 failed"; "           v: dive failed at 1:01: leak"; "  journal  m.run" ]
    (Run_summary.lines o ~now:61. ~journal:(Some "m.run") ~colour:false);
  lines "no end, no summary" [] (Run_summary.lines Run_summary.start ~now:0. ~journal:None ~colour:false)

let () =
  Alcotest.run "display"
    [ ("words", [ case "clock" clocks; case "duration" durations; case "harmless" harmless;
                  case "many vehicles" many_vehicles ]);
      ("log", [ case "a task" log_of_a_task; case "a stop" log_of_a_stop; case "deeds" log_of_deeds;
                case "strange names" log_of_strange_names; case "links" log_of_links;
                case "readiness" log_of_readiness ]);
      ("board", [ case "lines" board; case "a failed task" failed_task; case "what is waited for" waits;
                  case "guards" guards; case "many vehicles" large_board ]);
      ("what is shown", [ case "filters" filters; case "the end" summary ]) ]
