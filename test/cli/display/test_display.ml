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
  text "one in UTF-8" "a\xC2?31m" (Phrase.harmless "a\xC2\x9B31m");
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
        tuples = Tuples.empty (Keys []);
      };
  }

let transition ?(rules = []) ?(effects = []) ?(running = []) ?(bound = []) label : Transition.t =
  { rules; label; next = configuration bound running; effects; assumed = [] }

let told ts =
  let tell (log, reversed) (time, t) =
    let log, lines = Log.transition log ~time t in
    (log, List.rev_append lines reversed)
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
  { id; kind = "UUV"; payload = []; position = { latitude = 41.; longitude = -8.; height = 0. }; battery = 0.5;
    connected; unready }

let log_of_links () =
  let log, _ = Log.transition Log.start ~time:0. (transition ~bound:[ "v" ] (Bind [ "v" ])) in
  let log, lost = Log.news log ~time:1. (state ~connected:false "v") in
  let log, still = Log.news log ~time:2. (state ~connected:false "v") in
  let log, back = Log.news log ~time:3. (state "v") in
  let _, of_others = Log.news log ~time:4. (state ~connected:false "w") in
  lines "lost" [ "   0:01  v           loses its link" ] lost;
  lines "told once" [] still;
  lines "back" [ "   0:03  v           has its link back" ] back;
  lines "only of the program's vehicles" [] of_others

let log_of_readiness () =
  let log, _ = Log.transition Log.start ~time:0. (transition ~bound:[ "v" ] (Bind [ "v" ])) in
  let log, unready = Log.news log ~time:1. (state ~unready:"is in mode ERROR: leak" "v") in
  let log, still = Log.news log ~time:2. (state ~unready:"is in mode ERROR: leak" "v") in
  let log, lost = Log.news log ~time:3. (state ~connected:false "v") in
  let log, heard = Log.news log ~time:4. (state ~unready:"is in mode ERROR: leak" "v") in
  let _, ready = Log.news log ~time:5. (state "v") in
  lines "a link is something else" [ "   0:01  v           is in mode ERROR: leak" ] unready;
  lines "told once" [] still;
  lines "lost" [ "   0:03  v           loses its link" ] lost;
  lines "as before" [ "   0:04  v           has its link back" ] heard;
  lines "ready" [ "   0:05  v           is ready again" ] ready

let board () =
  let bound = [ "v"; "w" ] and p = task "dive" in
  let b = Status.transition Status.start ~time:0. (transition ~bound ~effects:[ Bind bound ] (Bind bound)) in
  let b =
    Status.transition b ~time:10.
      (transition ~bound ~running:[ ("v", p) ] ~effects:[ Start ("v", p) ] (Start ("v", "dive")))
  in
  let b = Status.news b ~time:75. (state "v") in
  let b = Status.news b ~time:75. (state ~connected:false "w") in
  lines "a line for each vehicle"
    [ "   1:15  2 vehicles, 1 busy"; "         v  dive  1:05  41.00000, -8.00000  50%    ";
      "         w  -           41.00000, -8.00000  no link" ]
    (Status.lines b);
  lines "no vehicle, no line" [] (Status.lines Status.start)

let large_board () =
  let bound = List.init 1000 (Printf.sprintf "v%d") in
  let b = Status.transition Status.start ~time:0. (transition ~bound (Bind bound)) in
  Alcotest.(check int) "fits a screen" (Status.most_lines + 2) (List.length (Status.lines b))

let () =
  Alcotest.run "display"
    [ ("words", [ case "clock" clocks; case "duration" durations; case "harmless" harmless;
                  case "many vehicles" many_vehicles ]);
      ("log", [ case "a task" log_of_a_task; case "a stop" log_of_a_stop; case "deeds" log_of_deeds;
                case "strange names" log_of_strange_names; case "links" log_of_links;
                case "readiness" log_of_readiness ]);
      ("board", [ case "lines" board; case "many vehicles" large_board ]) ]
