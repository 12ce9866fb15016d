open Dolphin_imc
open Dolphin_platform_imc

let loopback = Unix.inet_addr_loopback
let console = 0x5A0E

(* The recorded console numbered its requests from there. *)
let first_request = 61287

let station () =
  Station.create
    { id = console; name = "ccu-dolphin-5a0e"; program = "rendezvous.dol";
      addresses = [ { host = loopback; port = 34433 } ]; epoch = 1.795e9; first_request; payload = []; types = [];
      type_names = []; records = false; abort_after = None;
      run = ""; jitter = 0. }

type run = { station : Station.t; told : string list }  (* latest first *)

let tell now run text = { run with told = Printf.sprintf "%.3f %s" now text :: run.told }

let request bytes =
  match Packet.decode bytes with
  | Ok { content = Message (Plan_control { op; request_id; plan_id; type_ = Request; _ }); dst; _ } ->
    Some (dst, Printf.sprintf "%s %d %s" (Message.Plan_control.Op.name op) request_id plan_id, plan_id)
  | Ok _ | Error _ -> None

let rec take_all now run =
  match Station.take run.station with
  | None -> run
  | Some (event, station) ->
    let run = { run with station } in
    take_all now
      (match event with
       | Task_done v -> tell now run (v ^ " done")
       | Task_failed (v, why) -> tell now run (Printf.sprintf "%s failed: %s" v why)
       | Vehicle _ | Timer _ | Input _ | Quiet -> run)

let after now run (station, outputs) =
  let output run : Station.output -> run = function
    | Send { bytes; _ } -> (
        match request bytes with
        | Some (_, text, _) -> tell now run ("asks " ^ text)
        | None -> run)
    | Remark (v, text) -> tell now run (Printf.sprintf "%s: %s" v text)
    | Announce _ | Announce_to _ | Keep _ -> run
  in
  take_all now (List.fold_left output { run with station } outputs)

let name_of run id =
  let is_it (x : Station.system) = x.node.id = id in
  (List.find is_it (Station.systems ~now:0. run.station)).node.name

(* A console does something each second, though the recording has long gaps. *)
let rec live ~from ~until run =
  let now = from +. 1. in
  if now >= until then run else live ~from:now ~until (after now run (Station.tick ~now run.station))

(* Where the recorded console made a request, this one is told to make it. *)
let line (before, run) (line : Recording.line) =
  let now = line.time +. 1. in
  let run = live ~from:before ~until:now run in
  let run = after now run (Station.tick ~now run.station) in
  let run =
    if line.inward then after now run (Station.datagram ~now ~from:loopback line.bytes run.station)
    else
      match request line.bytes with
      | Some (dst, _, name) ->
        after now run (Station.start ~now (name_of run dst) { name; plan = None; task_site = 0 } run.station)
      | None -> Alcotest.fail "no request"
  in
  (now, run)

let replay ~until =
  let lines = List.filter (fun (l : Recording.line) -> l.time < until) (Lazy.force Recording.fleet) in
  snd (List.fold_left line (0., { station = station (); told = [] }) lines)

(* The errors are those of a task that has to do with no plan: each vehicle's are told once. *)
let swarm = "error of Maneuver.VehicleFormation.Swarm: unable to bind to socket: Address already in use"

let expected =
  [ "14.871 asks START 2433 survey1"; "14.871 asks START 2690 survey2"; "14.871 asks START 2947 survey3";
    "15.671 lauv-noptilus-2: " ^ swarm; "31.939 lauv-noptilus-3: " ^ swarm; "101.181 lauv-noptilus-2 done";
    "101.238 lauv-noptilus-3 done"; "101.268 asks START 2691 sk2"; "101.268 asks START 3461 rv2";
    "101.387 asks START 2948 sk3"; "102.193 lauv-noptilus-1 done"; "102.264 asks START 2434 sk1";
    "146.822 lauv-xplore-1 done"; "146.825 asks START 3462 rv1"; "178.770 lauv-xplore-1 done";
    "178.777 asks START 3463 rv3"; "222.071 lauv-xplore-1 done"; "809.480 lauv-noptilus-2 done";
    "811.611 lauv-noptilus-1 done"; "812.339 lauv-noptilus-3 done" ]

(* What the recorded console asked for. *)
let recorded () =
  let text (l : Recording.line) =
    match request l.bytes with
    | Some (_, text, _) when not l.inward -> Some (Printf.sprintf "%.3f asks %s" (l.time +. 1.) text)
    | Some _ | None -> None
  in
  List.filter_map text (Lazy.force Recording.fleet)

let requests_and_ends =
  Alcotest.test_case "requests and ends" `Quick (fun () ->
      let run = replay ~until:infinity in
      Alcotest.(check (list string)) "told" expected (List.rev run.told);
      let asked = List.filter (fun text -> List.mem text (recorded ())) expected in
      Alcotest.(check (list string)) "its requests" (recorded ()) asked;
      Alcotest.(check bool) "quiet" true (Station.quiet ~now:820. run.station);
      (* Vehicles send on what is asked of them, to whoever asked too. *)
      Alcotest.(check (list (pair string int))) "dropped" [ ("our own", 10) ] (Station.dropped run.station))

(* Which the recording has not kept. *)
let with_position now run (x : Station.system) =
  let here = Message.Estimated_state { Message.Estimated_state.default with lat = 0.7; lon = 0.1 } in
  let stamp = Vehicle_clock.latest x.node.clock +. 0.01 in
  let bytes = Result.get_ok (Packet.encode (Packet.make ~src:x.node.id ~timestamp:stamp here)) in
  after now run (Station.datagram ~now ~from:loopback bytes run.station)

let readiness =
  Alcotest.test_case "all are ready before the first request" `Quick (fun () ->
      let run = replay ~until:13.871 in
      let run = List.fold_left (with_position 14.871) run (Station.systems ~now:14.871 run.station) in
      let seen (x : Station.system) =
        Printf.sprintf "%s %s %b %s" x.state.id x.state.kind x.state.connected
          (Option.value x.state.unready ~default:"ready")
      in
      Alcotest.(check (list string)) "seen"
        [ "lauv-noptilus-1 UUV true ready"; "lauv-noptilus-2 UUV true ready"; "lauv-noptilus-3 UUV true ready";
          "lauv-xplore-1 UUV true ready" ]
        (List.map seen (Station.systems ~now:14.871 run.station)))

let tests = ("four DUNEs", [ requests_and_ends; readiness ])
