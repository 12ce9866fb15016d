open Dolphin_imc
open Dolphin_sim_imc

let case name run = Alcotest.test_case name `Quick run
let source = "vehicle 'a', { type 'UUV'; payload 'DVL', 'Sidescan'; at 41.1850, -8.7060; battery 80.percent; drain 0 }"
let control = Message.Plan_control_state Message.Plan_control_state.default
let supervision = Message.Vehicle_state Message.Vehicle_state.default
let navigation = Message.Estimated_state Message.Estimated_state.default
let fuel = Message.Fuel_level Message.Fuel_level.default
let telemetry s = List.length (List.filter (fun (h : Harness.heard) -> not h.announced) (Harness.heard s))

let about name expected got =
  if abs (expected - got) > 1 then Alcotest.failf "%s: %d, expected %d" name got expected

let announces () =
  let s = Harness.make (Harness.settings source) in
  Harness.until s 25.;
  match Harness.heard s with
  | [ { time = 0.; _ }; { time = 10.; _ };
      { time = 20.; packet = { content = Message (Announce a); dst; src; _ }; _ } ] ->
    Alcotest.(check string) "name" "a" a.sys_name;
    Alcotest.(check string) "type" "UUV" (Message.System_type.name a.sys_type);
    Alcotest.(check (pair int int)) "from and to" (Harness.vehicle, 0) (src, dst);
    Alcotest.(check bool) "services" true (Address.of_services a.services = [ { host = "127.0.0.1"; port = 6002 } ])
  | heard -> Alcotest.failf "%d packets" (List.length heard)

let needs_both () =
  let s = Harness.make (Harness.settings source) in
  Harness.announce s;
  Harness.until s 20.;
  Alcotest.(check int) "announced only" 0 (telemetry s);
  let s = Harness.make (Harness.settings source) in
  Harness.send s Heartbeat;
  Harness.until s 20.;
  Alcotest.(check int) "without announcement" 0 (telemetry s);
  Harness.announce s;
  Harness.send ~host:"10.0.0.7" s Heartbeat;
  Harness.until s 40.;
  Alcotest.(check int) "from another address" 0 (telemetry s);
  Harness.send s Heartbeat;
  Harness.until s 41.;
  Alcotest.(check bool) "both" true (telemetry s > 0)

let within_five_seconds () =
  let first seed =
    let s = Harness.make (Harness.settings ~contact_period:5. ~seed source) in
    Harness.until s 12.;
    Harness.join s;
    Harness.forget s;
    Harness.until s 17.;
    match List.find_opt (fun (h : Harness.heard) -> not h.announced) (Harness.heard s) with
    | Some h -> h.time -. 12.
    | None -> Alcotest.fail "nothing came"
  in
  let waits = List.init 20 first in
  Alcotest.(check bool) "sooner or later" true
    (List.exists (fun t -> t < 2.) waits && List.exists (fun t -> t > 3.) waits)

let rates () =
  let s = Harness.make (Harness.settings source) in
  Harness.join s;
  Harness.until s 10.;
  about "PlanControlState" 29 (Harness.count s control);
  about "VehicleState" 21 (Harness.count s supervision);
  about "EstimatedState" 19 (Harness.count s navigation);
  about "Heartbeat" 11 (Harness.count s Heartbeat - 1);
  about "FuelLevel" 11 (Harness.count s fuel)

let silent_after_thirty () =
  let s = Harness.make (Harness.settings source) in
  Harness.join s;
  Harness.until s 20.;
  Harness.send s Heartbeat;
  Harness.until s 49.5;
  let last = List.nth (Harness.heard s) (List.length (Harness.heard s) - 1) in
  Alcotest.(check bool) "still heard" true (last.time > 49.);
  Harness.until s 50.5;
  Harness.forget s;
  Harness.until s 100.;
  Alcotest.(check int) "silent" 0 (telemetry s);
  Harness.send s Heartbeat;
  Harness.until s 101.;
  Alcotest.(check bool) "heard again" true (telemetry s > 0)

let another_port () =
  let s = Harness.make (Harness.settings source) in
  Harness.join s;
  Harness.announce ~port:7777 s;
  Harness.send s Heartbeat;
  Harness.until s 5.;
  let ports =
    List.filter_map
      (fun a -> if (a : Address.t).port = 6001 then None else Some a.port)
      (Vehicle_node.listeners ~at:5. (Harness.node s))
  in
  Alcotest.(check (list int)) "only the first counts" [] ports

let several () =
  let s = Harness.make (Harness.settings source) in
  Harness.join s;
  Harness.announce ~id:0x4001 ~port:7001 s;
  Harness.send ~id:0x4001 s Heartbeat;
  Alcotest.(check int) "both are told" 2 (List.length (Vehicle_node.listeners ~at:0. (Harness.node s)));
  Harness.forget s;
  Harness.start s 1 "p";
  let relayed (h : Harness.heard) = h.packet.src = Harness.console in
  Alcotest.(check int) "requests are sent on" 1 (List.length (List.filter relayed (Harness.heard s)))

let stamps () =
  let s = Harness.make (Harness.settings source) in
  Harness.join s;
  Harness.start s 1 "p";
  Harness.until s 20.;
  let own (h : Harness.heard) = if h.packet.src = Harness.vehicle then Some h.packet.timestamp else None in
  let stamps = List.filter_map own (Harness.heard s) in
  Alcotest.(check bool) "each later than the one before" true (stamps = List.sort_uniq Float.compare stamps)

let addressed () =
  let s = Harness.make (Harness.settings source) in
  Harness.join s;
  let starts dst =
    Harness.forget s;
    Harness.start ~dst s 1 "p";
    List.length (Harness.activities s)
  in
  Alcotest.(check (list int)) "own, broadcast, another, nobody" [ 1; 1; 0; 0 ]
    (List.map starts [ Harness.vehicle; Header.broadcast; 0x1B; Header.nobody ])

let entities () =
  let s = Harness.make (Harness.settings source) in
  Harness.join s;
  Harness.send s (Entity_list { op = Query; list = "" });
  let report (h : Harness.heard) =
    match h.packet with
    | { content = Message (Entity_list { op = Report; list }); dst; _ } when dst = Harness.console -> Some list
    | _ -> None
  in
  match List.filter_map report (Harness.heard s) with
  | [ list ] ->
    let names = List.map fst (Tuple_list.of_string list) in
    Alcotest.(check bool) "payload" true (List.mem "DVL" names && List.mem "Sidescan" names)
  | reports -> Alcotest.failf "%d reports" (List.length reports)

let battery () =
  let s = Harness.make (Harness.settings source) in
  Harness.join s;
  Harness.until s 0.;
  let level (h : Harness.heard) =
    match h.packet.content with Message (Fuel_level f) -> Some f.value | Message _ | Unknown _ -> None
  in
  Alcotest.(check (list (float 1e-3))) "percent" [ 80. ] (List.filter_map level (Harness.heard s))

(* Values without a message in IMC are not sent. *)
let measurements () =
  let shows = "vehicle 'a', { type 'UUV'; shows 'Salinity', 35; shows 'Taste', 1; shows 'Temperature', 14.5 }" in
  let s = Harness.make (Harness.settings shows) in
  Harness.join s;
  Harness.until s 1.;
  let told (h : Harness.heard) =
    match h.packet.content with Message m -> Measurement.of_message m | Unknown _ -> None
  in
  let all = List.sort_uniq compare (List.filter_map told (Harness.heard s)) in
  Alcotest.(check (list (pair string (float 1e-3)))) "quantities" [ ("Salinity", 35.); ("Temperature", 14.5) ] all

(* EstimatedState is a place and a displacement: both together are where the vehicle is. *)
let moves () =
  let s = Harness.make (Harness.settings ~speed:10. (source ^ "\nplan 'p', { duration 10.min }")) in
  Harness.join s;
  Harness.start s 1 "p";
  Harness.until s 30.;
  let check (h : Harness.heard) =
    match h.packet.content with
    | Message (Estimated_state e) ->
      let position latitude longitude : Dolphin_geo.Position.t = { latitude; longitude; height = 0. } in
      let reference = position (Dolphin_geo.Angle.degrees e.lat) (Dolphin_geo.Angle.degrees e.lon) in
      let there = Dolphin_geo.Wgs84.displace reference ~north:e.x ~east:e.y in
      let truth = Vehicle_node.position ~at:h.time (Harness.node s) in
      if Dolphin_geo.Wgs84.distance there truth > 0.1 then Alcotest.failf "not there at %g" h.time;
      Some (Float.hypot e.x e.y)
    | Message _ | Unknown _ -> None
  in
  let distances = List.filter_map check (Harness.heard s) in
  Alcotest.(check bool) "gets about" true (List.exists (fun d -> d > 50.) distances)

let vanishes () =
  let s = Harness.make (Harness.settings ("vehicle 'a', { type 'UUV'; joins 15; leaves 100; drops 40, 20 }")) in
  Harness.join s;
  Harness.until s 14.9;
  Alcotest.(check int) "not yet there" 0 (List.length (Harness.heard s));
  Harness.join s;
  Harness.until s 15.;
  Harness.join s;
  let rec go time =
    if time < 120. then begin
      Harness.until s time;
      Harness.send s Heartbeat;
      go (time +. 1.)
    end
  in
  go 16.;
  let silent from until =
    not (List.exists (fun (h : Harness.heard) -> from <= h.time && h.time < until) (Harness.heard s)) in
  Alcotest.(check (list bool)) "heard and not heard" [ false; true; false; true ]
    [ silent 15. 40.; silent 40. 60.; silent 60. 100.; silent 100. 200. ]

let tests =
  [ case "announces itself every ten seconds" announces;
    case "speaks to who has announced itself and sent something" needs_both;
    case "speaks within five seconds" within_five_seconds;
    case "tells of itself as often as measured" rates;
    case "is silent thirty seconds after the last packet" silent_after_thirty;
    case "knows a system by its first port" another_port;
    case "speaks to several, and sends requests on" several;
    case "stamps each packet later than the one before" stamps;
    case "takes requests for itself and for all" addressed;
    case "lists its entities" entities;
    case "tells its battery" battery;
    case "tells what it measures" measurements;
    case "tells its position by a reference and offsets" moves;
    case "vanishes and returns" vanishes ]
