open Dolphin_imc
open Dolphin_platform_imc
open Dolphin_runtime
module State = Message.Plan_control_state

let loopback = Unix.inet_addr_loopback
let vehicle = 0x1A
let vehicle_port = 6002

(* {1 A world of consoles} *)

type console = {
  id : int;
  port : int;
  mutable station : Station.t;
  mutable picked : float option;  (* its program waits for lauv-1, picks it, and starts plan p at once *)
  mutable wants : bool;
  mutable failures : string list;
  mutable started : float list;  (* when its requests to start reached the vehicle *)
}

type world = {
  mutable now : float;
  consoles : console list;
  latency : float;
  mutable under_way : (float * int * string) list;  (* datagrams: when they arrive, at which port *)
}

let settings ?(run = "") ?(jitter = 0.) id port : Station.settings =
  { id; name = Printf.sprintf "ccu-%x" id; program = "p.dol"; addresses = [ { host = loopback; port } ]; epoch = 0.;
    first_request = id; payload = []; types = []; type_names = []; records = false; abort_after = None; run; jitter }

let console ?(wants = true) station id port =
  { id; port; station; picked = None; wants; failures = []; started = [] }

let encoded ~now ~src ?(dst = Header.nobody) message =
  Result.get_ok (Packet.encode (Packet.make ~src ~dst ~timestamp:now message))

let send w port bytes = w.under_way <- (w.now +. w.latency, port, bytes) :: w.under_way

let carry_out w c : Station.output -> unit = function
  | Send { address; bytes } when address.port = vehicle_port -> (
      match Packet.decode bytes with
      | Ok { content = Message (Plan_control { op = Start; type_ = Request; _ }); _ } ->
        c.started <- (w.now +. w.latency) :: c.started
      | Ok _ | Error _ -> ())
  | Send { address; bytes } -> send w address.port bytes
  | Announce _ | Announce_to _ | Keep _ | Remark _ -> ()

let change w c (station, outputs) =
  c.station <- station;
  List.iter (carry_out w c) outputs

let task : Dolphin_semantics.Core.platform_task = { name = "p"; plan = None; task_site = 0 }

(* The program of [c]. *)
let rec live w c =
  match Station.take c.station with
  | None -> ()
  | Some (event, station) ->
    c.station <- station;
    (match event with
     | Platform.Vehicle { id = "lauv-1"; connected = true; unready = None; _ } when c.wants && c.picked = None ->
       c.picked <- Some w.now;
       change w c (Station.bind ~now:w.now [ "lauv-1" ] c.station);
       change w c (Station.start ~now:w.now "lauv-1" task c.station)
     | Task_failed (_, why) -> c.failures <- why :: c.failures
     | Vehicle _ | Task_done _ | Timer _ | Input _ | Quiet -> ());
    live w c

let hear w c bytes =
  change w c (Station.datagram ~now:w.now ~from:loopback bytes c.station);
  live w c

let instant = 0.01

let step ?(asleep = fun _ -> false) w said =
  w.now <- w.now +. instant;
  let arrived, later = List.partition (fun (at, _, _) -> at <= w.now) w.under_way in
  w.under_way <- later;
  let awake = List.filter (fun c -> not (asleep c)) w.consoles in
  List.iter
    (fun (_, port, bytes) -> List.iter (fun c -> if c.port = port then hear w c bytes) awake)
    (List.sort compare arrived);
  List.iter (fun message -> List.iter (fun c -> hear w c (encoded ~now:w.now ~src:vehicle message)) awake) said;
  List.iter
    (fun c ->
       if Station.due c.station <= w.now then change w c (Station.tick ~now:w.now c.station);
       live w c)
    awake

let announce name sys_type port =
  Message.Announce
    { Message.Announce.default with
      sys_name = name; sys_type; services = Printf.sprintf "imc+udp://127.0.0.1:%d/" port }

let says state = Message.Plan_control_state { State.default with state; plan_id = "q" }

let here = Message.Estimated_state { Message.Estimated_state.default with lat = 0.7; lon = 0.1 }

(* What the vehicle says at a time, being busy until [free]. *)
let telemetry w ~free =
  let tick = int_of_float (Float.round (w.now /. instant)) in
  if tick mod 33 <> 0 then [] else [ here; says (if w.now < free then Executing else Ready) ]

let introduce w =
  let meet c =
    let hear src message = hear w c (encoded ~now:w.now ~src message) in
    hear vehicle (announce "lauv-1" Uuv vehicle_port);
    List.iter (fun o -> hear o.id (announce (Printf.sprintf "ccu-%x" o.id) Ccu o.port)) w.consoles
  in
  List.iter meet w.consoles

let run ?asleep w ~free ~until =
  while w.now < until do step ?asleep w (telemetry w ~free) done

let commanders w = List.filter (fun c -> c.started <> []) w.consoles

(* {1 Three that wait for one vehicle} *)

let orders =
  let open QCheck2.Gen in
  let* latency = float_range 0.001 0.1
  and* jitters = list_repeat 3 (oneof [ return 0.; float_range 0. 1. ])
  and* ids = shuffle_l [ 0x4001; 0x4002; 0x4003 ]
  and* free = float_range 4. 6. in
  return (latency, jitters, ids, free)

let print = QCheck2.Print.(quad float (list float) (list int) float)

let one_of_three (latency, jitters, ids, free) =
  let make i (id, jitter) =
    let port = 6100 + i in
    console (Station.create (settings ~run:(string_of_int id) ~jitter id port)) id port
  in
  let consoles = List.mapi make (List.combine ids jitters) in
  let w = { now = 0.; consoles; latency; under_way = [] } in
  introduce w;
  run w ~free ~until:12.;
  match commanders w with
  | [ _ ] -> true
  | found -> QCheck2.Test.fail_reportf "%d consoles command it" (List.length found)

let three =
  Test_support.Property.case ~count:200 "three consoles wait for one vehicle: one commands it" ~print orders one_of_three

(* {1 After a sleep} *)

let held_by_other = "is held by the program p.dol of ccu-4002"

let slept =
  Alcotest.test_case "a console that slept does not start on a vehicle that another one has taken" `Quick (fun () ->
      let sleeper = console ~wants:false (Station.create (settings ~run:"a" 0x4001 6101)) 0x4001 6101 in
      let other = console ~wants:false (Station.create (settings ~run:"b" 0x4002 6102)) 0x4002 6102 in
      let w = { now = 0.; consoles = [ sleeper; other ]; latency = 0.01; under_way = [] } in
      introduce w;
      run w ~free:0. ~until:3.;
      change w sleeper (Station.bind ~now:w.now [ "lauv-1" ] sleeper.station);
      run w ~free:0. ~until:5.;
      let asleep c = c == sleeper in
      run ~asleep w ~free:0. ~until:9.;
      other.wants <- true;
      run ~asleep w ~free:0. ~until:20.;
      Alcotest.(check bool) "the other took it" true (other.started <> []);
      change w sleeper (Station.start ~now:w.now "lauv-1" task sleeper.station);
      run w ~free:0. ~until:25.;
      Alcotest.(check int) "nothing was started" 0 (List.length sleeper.started);
      Alcotest.(check (list string)) "why" [ held_by_other ] sleeper.failures)

(* A drawn console, beside another one that waits for the vehicle: it holds the vehicle, sleeps, and has its program
   start a plan afterwards, or it resumes a run that held the vehicle. *)
type absence = {
  latency : float;
  jitters : float * float;
  is_lower : bool;  (* its address *)
  from : float;
  length : float;  (* the console sleeps, or is dead *)
  is_resumed : bool;
  is_heard_late : bool;  (* what came meanwhile is heard afterwards *)
  wanted : float;  (* from then on by the other console *)
  starts : float;  (* so long after the sleep *)
}

let absences =
  let open QCheck2.Gen in
  let* latency = float_range 0.001 0.1
  and* jitters = pair (float_range 0. 1.) (float_range 0. 1.)
  and* is_lower = bool
  and* from = float_range 3. 5.
  and* length = float_range 0. 15.
  and* is_resumed = bool
  and* is_heard_late = bool
  and* wanted = float_range 0. 22.
  and* starts = oneof [ return 0.; float_range 0. 5. ] in
  return { latency; jitters; is_lower; from; length; is_resumed; is_heard_late; wanted; starts }

let print_absence a =
  Printf.sprintf
    "latency %g, jitters %g and %g, is_lower %b, from %g, length %g, is_resumed %b, is_heard_late %b, wanted %g, starts %g"
    a.latency (fst a.jitters) (snd a.jitters) a.is_lower a.from a.length a.is_resumed a.is_heard_late a.wanted a.starts

let outstanding : History.outstanding =
  { bound = [ "lauv-1" ];
    tasks = [ ("lauv-1", { task; number = 0; is_again = false; is_stopped = false; notes = []; before = None }) ];
    timers = []; timeout = None; timeouts = [] }

(* The other console begins to want the vehicle, at its time. *)
let advance ?asleep w other a ~until =
  while w.now < until do
    other.wants <- w.now >= a.wanted;
    live w other;
    step ?asleep w (telemetry w ~free:0.)
  done

let one_after_an_absence a =
  let jitter, other_jitter = a.jitters in
  let id, other_id = if a.is_lower then (0x4001, 0x4002) else (0x4002, 0x4001) in
  let other_settings = settings ~run:"b" ~jitter:other_jitter other_id 6102 in
  let settings = settings ~run:"a" ~jitter id 6101 in
  let absent = console ~wants:false (Station.create settings) id 6101 in
  let other = console ~wants:false (Station.create other_settings) other_id 6102 in
  let w = { now = 0.; consoles = [ absent; other ]; latency = a.latency; under_way = [] } in
  introduce w;
  advance w other a ~until:2.;
  change w absent (Station.bind ~now:w.now [ "lauv-1" ] absent.station);
  advance w other a ~until:a.from;
  let waking = a.from +. a.length in
  let asleep c = c == absent in
  let missed = ref [] in
  while w.now < waking do
    let for_absent, others = List.partition (fun (_, port, _) -> port = 6101) w.under_way in
    missed := for_absent @ !missed;
    w.under_way <- others;
    advance ~asleep w other a ~until:(w.now +. instant)
  done;
  if a.is_resumed then begin
    absent.station <- Station.resume ~now:w.now outstanding (Station.create settings);
    introduce w
  end
  else begin
    if a.is_heard_late then List.iter (fun (_, _, bytes) -> hear w absent bytes) (List.sort compare !missed);
    advance w other a ~until:(waking +. a.starts);
    change w absent (Station.start ~now:w.now "lauv-1" task absent.station)
  end;
  advance w other a ~until:(waking +. 40.);
  match commanders w with
  | [ _ ] -> true
  | found -> QCheck2.Test.fail_reportf "%d consoles command it" (List.length found)

let absent =
  Test_support.Property.case ~count:300 "beside a console that slept or is resumed: one commands the vehicle"
    ~print:print_absence absences one_after_an_absence

let repeated =
  Alcotest.test_case "a request without effect is repeated after a sleep only once others were listened for" `Quick
    (fun () ->
       let c = console (Station.create (settings ~run:"a" 0x4001 6101)) 0x4001 6101 in
       let w = { now = 0.; consoles = [ c ]; latency = 0.01; under_way = [] } in
       introduce w;
       run w ~free:0. ~until:5.;
       let before = List.length c.started in
       Alcotest.(check bool) "it was requested" true (before > 0);
       w.now <- 20.;
       hear w c (encoded ~now:w.now ~src:vehicle (says Ready));
       Alcotest.(check int) "before the console notices its sleep" before (List.length c.started);
       run w ~free:0. ~until:23.;
       Alcotest.(check int) "while it listens" before (List.length c.started);
       run w ~free:0. ~until:30.;
       Alcotest.(check bool) "afterwards" true (List.length c.started > before))

let silence =
  Alcotest.test_case "the silence while a console slept is not the vehicle's" `Quick (fun () ->
      let c = console (Station.create (settings ~run:"a" 0x4001 6101)) 0x4001 6101 in
      let w = { now = 0.; consoles = [ c ]; latency = 0.01; under_way = [] } in
      introduce w;
      run w ~free:0. ~until:5.;
      Alcotest.(check bool) "it runs" true (c.started <> []);
      run ~asleep:(fun _ -> true) w ~free:0. ~until:75.;
      run w ~free:0. ~until:78.;
      Alcotest.(check bool) "no failure for silence" true
        (List.for_all (fun why -> not (String.length why > 7 && String.sub why 0 7 = "no word")) c.failures))

(* {1 Resumption} *)

let resumed ?run id port =
  let station = Station.resume ~now:0. outstanding (Station.create (settings ?run id port)) in
  console ~wants:false station id port

let resume consoles =
  let w = { now = 0.; consoles; latency = 0.01; under_way = [] } in
  introduce w;
  run w ~free:0. ~until:6.

let copied =
  Alcotest.test_case "a copy of a run that lives is not resumed" `Quick (fun () ->
      let living = console ~wants:false (Station.create (settings ~run:"a" 0x4003 6103)) 0x4003 6103 in
      let copy = resumed ~run:"a" 0x4001 6101 in
      resume [ living; copy ];
      Alcotest.(check (option string)) "where it lives" (Some "ccu-4003") (Station.twin copy.station);
      let only = resumed ~run:"a" 0x4001 6101 in
      let stranger = console ~wants:false (Station.create (settings ~run:"b" 0x4003 6103)) 0x4003 6103 in
      resume [ stranger; only ];
      Alcotest.(check (option string)) "another run" None (Station.twin only.station);
      Alcotest.(check bool) "it goes on" true (only.started <> []))

let both =
  Alcotest.test_case "of two copies that are resumed at once one goes on" `Quick (fun () ->
      let a = resumed ~run:"a" 0x4001 6101 and b = resumed ~run:"a" 0x4002 6102 in
      resume [ a; b ];
      Alcotest.(check (option string)) "the lower one" None (Station.twin a.station);
      Alcotest.(check (option string)) "the other" (Some "ccu-4001") (Station.twin b.station))

let held =
  Alcotest.test_case "what another console holds is not resumed" `Quick (fun () ->
      let holder = console ~wants:false (Station.create (settings ~run:"b" 0x4002 6102)) 0x4002 6102 in
      holder.station <- fst (Station.bind ~now:0. [ "lauv-1" ] holder.station);
      let c = resumed ~run:"a" 0x4001 6101 in
      resume [ holder; c ];
      Alcotest.(check int) "nothing was started" 0 (List.length c.started);
      Alcotest.(check (list string)) "why" [ held_by_other ] c.failures)

let tests = ("holds", [ three; slept; absent; repeated; silence; copied; both; held ])
