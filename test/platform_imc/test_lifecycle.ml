open Dolphin_semantics
open Dolphin_runtime
open Dolphin_imc
open Dolphin_platform_imc

let loopback = Unix.inet_addr_loopback

(* So that the vehicle's requests are numbered from [request]. *)
let first_request request = (request - (0x1A * 257)) land 0xFFFF

let station ~request =
  Station.create
    { id = Recording.console; name = "ccu-test"; program = ""; addresses = [ { host = loopback; port = 6001 } ]; epoch = 1.79e9;
      first_request = first_request request; payload = []; types = []; type_names = []; records = false;
      abort_after = None;
      run = ""; jitter = 0. }

type run = { station : Station.t; events : (float * Platform.event) list; sent : (float * Message.t) list }

let rec take_all ~now run =
  match Station.take run.station with
  | None -> run
  | Some (event, station) -> take_all ~now { run with station; events = (now, event) :: run.events }

let sent_by outputs =
  let message : Station.output -> Message.t option = function
    | Send { bytes; _ } -> (
        match Packet.decode bytes with
        | Ok { content = Message m; _ } -> Some m
        | Ok { content = Unknown _; _ } | Error _ -> Alcotest.fail "sent something broken")
    | Announce _ | Announce_to _ | Keep _ | Remark _ -> None
  in
  List.filter_map message outputs

let after ~now run (station, outputs) =
  let sent = List.map (fun m -> (now, m)) (sent_by outputs) in
  take_all ~now { run with station; sent = List.rev_append sent run.sent }

let control (m : Message.t) : Message.t Message.Plan_control.t option =
  match m with Plan_control c -> Some c | _ -> None

(* The console that was recorded did what [commands] says when it sent the request of that number: [`Start] or [`Stop];
   its other requests are those of another console. Of the vehicle's datagrams those are heard that [keep]. *)
let replay ?(keep = fun _ -> true) ?(until = infinity) ~request commands =
  let act run (line : Recording.line) =
    let now = line.time in
    match control (Recording.message line) with
    | Some c -> (
        match List.assoc_opt c.request_id commands with
        | Some `Start ->
          let task = { Core.name = c.plan_id; plan = None; task_site = 0 } in
          after ~now run (Station.start ~now Recording.vehicle task run.station)
        | Some `Stop -> after ~now run (Station.stop ~now Recording.vehicle run.station)
        | None -> run)
    | None -> run
  in
  (* Repeated datagrams are left out of the recording; a console that is awake has ticks meanwhile. *)
  let rec tick ~last ~now run =
    let next = Float.min now (last +. 1.) in
    let run = after ~now:next run (Station.tick ~now:next run.station) in
    if next < now then tick ~last:next ~now run else run
  in
  let hear (run, last) (line : Recording.line) =
    let now = line.time in
    let run = tick ~last ~now run in
    let run =
      if not line.inward then act run line
      else if keep line then after ~now run (Station.datagram ~now ~from:loopback line.bytes run.station)
      else run
    in
    (run, now)
  in
  let lines = List.filter (fun (l : Recording.line) -> l.time < until) (Lazy.force Recording.lines) in
  fst (List.fold_left hear ({ station = station ~request; events = []; sent = [] }, 0.) lines)

let verdicts run =
  List.filter_map
    (fun (time, (event : Platform.event)) ->
       match event with
       | Task_done v -> Some (Printf.sprintf "%.3f %s done" time v)
       | Task_failed (v, why) -> Some (Printf.sprintf "%.3f %s failed: %s" time v why)
       | Vehicle _ | Timer _ | Input _ | Quiet -> None)
    (List.rev run.events)

let requests run =
  List.filter_map
    (fun (_, m) ->
       match control m with
       | Some c -> Some (Printf.sprintf "%s %d %s" (Message.Plan_control.Op.name c.op) c.request_id c.plan_id)
       | None -> None)
    (List.rev run.sent)

let strings = Alcotest.(list string)
let the_end = List.fold_left (fun _ (line : Recording.line) -> line.time) 0. (Lazy.force Recording.lines)

let case name ?keep ?until ~request commands ~verdict ~asked =
  Alcotest.test_case name `Quick (fun () ->
      let run = replay ?keep ?until ~request commands in
      Alcotest.check strings "verdict" verdict (verdicts run);
      Alcotest.check strings "requests" asked (requests run);
      Alcotest.(check bool) "quiet" true (Station.quiet ~now:the_end run.station);
      Alcotest.(check (list (pair string string))) "unsettled" [] (Station.unsettled ~now:the_end run.station))

(* {1 What may get lost} *)

let is_reply line = control (Recording.message line) <> None

let state (line : Recording.line) : Message.Plan_control_state.t option =
  match Recording.message line with Plan_control_state s -> Some s | _ -> None

let is_executing plan line =
  match state line with Some { state = Executing; plan_id; _ } -> plan_id = plan | Some _ | None -> false

let is_change line =
  match state line with Some { state = Initializing | Executing; _ } -> true | Some _ | None -> false

let without p line = not (p line)

(* {1 Seen as a vehicle} *)

let last_state ?(before = infinity) run =
  List.find_map
    (fun (time, (event : Platform.event)) -> match event with Vehicle s when time < before -> Some s | _ -> None)
    run.events

let seen =
  Alcotest.test_case "the vehicle as programs see it" `Quick (fun () ->
      let run = replay ~request:1 [] ~until:20. in
      (match Station.systems ~now:20. run.station with
       | [ { state = s; linked; node; _ } ] ->
         Alcotest.(check string) "id" Recording.vehicle s.id;
         Alcotest.(check string) "kind" "UUV" s.kind;
         Alcotest.(check bool) "connected" true s.connected;
         Alcotest.(check bool) "linked" true linked;
         Alcotest.(check string) "mode" "SERVICE" (Node.mode ~names:[] node);
         Alcotest.(check bool) "payload" true (World.carries [ "DVL"; "gps" ] s);
         Alcotest.(check bool) "not on board" false (World.carries [ "Sidescan" ] s);
         let apdl = Dolphin_geo.Place.apdl in
         Alcotest.(check bool) "near APDL" true (Dolphin_geo.Wgs84.distance apdl s.position < 1000.)
       | sights -> Alcotest.failf "%d systems" (List.length sights));
      (* It was announced, and not picked, before it spoke of its mode. *)
      match last_state ~before:9. run with
      | Some s -> Alcotest.(check bool) "not yet" false s.connected
      | None -> Alcotest.fail "not told of")

let busy =
  Alcotest.test_case "a vehicle that runs a plan of another console cannot be picked" `Quick (fun () ->
      let run = replay ~request:1 [] ~until:18. in
      match last_state run with
      | Some s ->
        Alcotest.(check bool) "has a link" true s.connected;
        Alcotest.(check (option string)) "and is not ready" (Some "runs plan planA") s.unready
      | None -> Alcotest.fail "not told of")

(* When the console announces itself while a vehicle announces itself and says nothing. *)
let courtship =
  Alcotest.test_case "a vehicle that does not answer is courted" `Quick (fun () ->
      let bytes = (List.find (fun (l : Recording.line) -> l.inward) (Lazy.force Recording.lines)).bytes in
      let rec live now (s, announced) =
        if now > 30. then List.rev announced
        else
          let s, outputs = Station.tick ~now s in
          let is_announcement : Station.output -> bool = function
            | Announce _ -> true
            | Announce_to _ | Send _ | Keep _ | Remark _ -> false
          in
          let speaks = List.exists is_announcement outputs in
          let announced = if speaks then Float.round now :: announced else announced in
          let s = if Float.rem now 10. = 2. then fst (Station.datagram ~now ~from:loopback bytes s) else s in
          live (now +. 0.25) (s, announced)
      in
      Alcotest.(check (list (float 0.)))
        "times"
        [ 0.; 3.; 4.; 5.; 6.; 7.; 8.; 9.; 10.; 11.; 12.; 13.; 14.; 15.; 16.; 17.; 27. ]
        (live 0. (station ~request:1, [])))

(* The vehicle says nothing any more since the console sent the request of this number. *)
let silent_since request =
  let is_it line = match control (Recording.message line) with Some c -> c.request_id = request | None -> false in
  let at = (List.find is_it (Lazy.force Recording.lines)).time in
  fun (line : Recording.line) -> line.time <= at

let unsettled =
  Alcotest.test_case "what a silent vehicle may still run" `Quick (fun () ->
      let check what plans run =
        let expected = List.map (fun plan -> (Recording.vehicle, plan)) plans in
        Alcotest.(check (list (pair string string))) what expected (Station.unsettled ~now:the_end run.station)
      in
      let stopped = replay ~request:101 [ (101, `Start); (102, `Stop) ] ~keep:(silent_since 102) in
      check "its stop is not confirmed" [ "planA" ] stopped;
      let lost = replay ~request:109 [ (109, `Start) ] ~keep:(silent_since 109) in
      check "it runs for the program" [] lost;
      let tick run i =
        let now = the_end +. float_of_int i in
        after ~now run (Station.tick ~now run.station)
      in
      let lost = List.fold_left tick lost (List.init 140 Fun.id) in
      Alcotest.check strings "lost" [ "109.250 lauv-noptilus-1 failed: no word from the vehicle for 60 seconds" ]
        (verdicts lost);
      check "its link was given up" [ "planB" ] lost)

let failed time why = [ Printf.sprintf "%.3f lauv-noptilus-1 failed: %s" time why ]

let tests =
  ( "lifecycle",
    [ seen; busy; courtship; unsettled;
      case "start, then stop" ~request:101 [ (101, `Start); (102, `Stop) ] ~verdict:[]
        ~asked:[ "START 101 planA"; "STOP 102 planA" ];
      case "start, then stop, the reply being lost" ~request:101 [ (101, `Start); (102, `Stop) ]
        ~keep:(without is_reply) ~verdict:[] ~asked:[ "START 101 planA"; "STOP 102 planA" ];
      case "unknown plan" ~request:103 [ (103, `Start) ] ~verdict:(failed 21.126 "undefined plan")
        ~asked:[ "START 103 nonexistent" ];
      case "unknown plan, the words being lost" ~request:103 [ (103, `Start) ] ~keep:(without is_reply)
        ~verdict:(failed 23.450 "the plan was refused, and the vehicle gave no reason")
        ~asked:[ "START 103 nonexistent" ];
      case "unsupported maneuver" ~request:104 [ (104, `Start) ]
        ~verdict:(failed 24.126 "parse error: 1: maneuver is not supported")
        ~asked:[ "START 104 planC" ];
      case "replaced" ~request:105 [ (105, `Start) ] ~verdict:(failed 31.141 "replaced by plan planI2")
        ~asked:[ "START 105 planI" ];
      case "replaced, which is seen only when the other plan is over" ~request:105 [ (105, `Start) ]
        ~keep:(without (is_executing "planI2")) ~verdict:(failed 35.146 "replaced by plan planI2")
        ~asked:[ "START 105 planI" ];
      case "killed by another console's refused start" ~request:106 [ (106, `Start) ]
        ~verdict:(failed 36.400 "the plan ended without success, and the vehicle gave no reason")
        ~asked:[ "START 106 planI2" ];
      case "beyond limits" ~request:107 [ (107, `Start) ]
        ~verdict:(failed 35.145 "parse error: 1: maneuver depth beyond limits")
        ~asked:[ "START 107 planBad" ];
      case "aborted" ~request:108 [ (108, `Start) ]
        ~verdict:(failed 43.307 "got abort request from system ccu-dolphin-0001 - 0x4ABC @ 0x01")
        ~asked:[ "START 108 planK" ];
      case "aborted, the reply being lost" ~request:108 [ (108, `Start) ] ~keep:(without is_reply)
        ~verdict:(failed 44.450 "got abort request from system ccu-dolphin-0001 - 0x4ABC @ 0x01")
        ~asked:[ "START 108 planK" ];
      case "run to completion" ~request:109 [ (109, `Start) ] ~verdict:[ "63.305 lauv-noptilus-1 done" ]
        ~asked:[ "START 109 planB" ];
      case "run to completion, all replies being lost" ~request:109 [ (109, `Start) ] ~keep:(without is_reply)
        ~verdict:[ "63.305 lauv-noptilus-1 done" ] ~asked:[ "START 109 planB" ];
      case "run to completion, never seen to run" ~request:109 [ (109, `Start) ] ~keep:(without is_change)
        ~verdict:[ "63.305 lauv-noptilus-1 done" ] ~asked:[ "START 109 planB" ] ] )
