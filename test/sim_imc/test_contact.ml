open Dolphin_imc
open Dolphin_sim_imc

let case name run = Alcotest.test_case name `Quick run
let source = "vehicle 'a', { type 'UUV'; payload 'DVL', 'Sidescan'; at 41.1850, -8.7060; battery 80.percent; drain 0 }"
let control = Message.Plan_control_state Message.Plan_control_state.default
let supervision = Message.Vehicle_state Message.Vehicle_state.default
let navigation = Message.Estimated_state Message.Estimated_state.default
let fuel = Message.Fuel_level Message.Fuel_level.default
let telemetry s = List.length (List.filter (fun (h : Scene.heard) -> not h.announced) (Scene.heard s))

let about name expected got =
  if abs (expected - got) > 1 then Alcotest.failf "%s: %d, expected %d" name got expected

let announces () =
  let s = Scene.make (Scene.settings source) in
  Scene.until s 25.;
  match Scene.heard s with
  | [ { time = 0.; _ }; { time = 10.; _ };
      { time = 20.; packet = { content = Message (Announce a); dst; src; _ }; _ } ] ->
    Alcotest.(check string) "name" "a" a.sys_name;
    Alcotest.(check string) "type" "UUV" (Message.System_type.name a.sys_type);
    Alcotest.(check (pair int int)) "from and to" (Scene.vehicle, 0) (src, dst);
    Alcotest.(check bool) "services" true (Address.of_services a.services = [ { host = "127.0.0.1"; port = 6002 } ])
  | heard -> Alcotest.failf "%d packets" (List.length heard)

let needs_both () =
  let s = Scene.make (Scene.settings source) in
  Scene.announce s;
  Scene.until s 20.;
  Alcotest.(check int) "announced only" 0 (telemetry s);
  let s = Scene.make (Scene.settings source) in
  Scene.send s Heartbeat;
  Scene.until s 20.;
  Alcotest.(check int) "without announcement" 0 (telemetry s);
  Scene.announce s;
  Scene.send ~host:"10.0.0.7" s Heartbeat;
  Scene.until s 40.;
  Alcotest.(check int) "from another address" 0 (telemetry s);
  Scene.send s Heartbeat;
  Scene.until s 41.;
  Alcotest.(check bool) "both" true (telemetry s > 0)

let within_five_seconds () =
  let first seed =
    let s = Scene.make (Scene.settings ~contact_period:5. ~seed source) in
    Scene.until s 12.;
    Scene.join s;
    Scene.forget s;
    Scene.until s 17.;
    match List.find_opt (fun (h : Scene.heard) -> not h.announced) (Scene.heard s) with
    | Some h -> h.time -. 12.
    | None -> Alcotest.fail "nothing came"
  in
  let waits = List.init 20 first in
  Alcotest.(check bool) "sooner or later" true
    (List.exists (fun t -> t < 2.) waits && List.exists (fun t -> t > 3.) waits)

let rates () =
  let s = Scene.make (Scene.settings source) in
  Scene.join s;
  Scene.until s 10.;
  about "PlanControlState" 29 (Scene.count s control);
  about "VehicleState" 21 (Scene.count s supervision);
  about "EstimatedState" 21 (Scene.count s navigation);
  about "Heartbeat" 11 (Scene.count s Heartbeat - 1);
  about "FuelLevel" 11 (Scene.count s fuel)

let silent_after_thirty () =
  let s = Scene.make (Scene.settings source) in
  Scene.join s;
  Scene.until s 20.;
  Scene.send s Heartbeat;
  Scene.until s 49.5;
  let last = List.nth (Scene.heard s) (List.length (Scene.heard s) - 1) in
  Alcotest.(check bool) "still heard" true (last.time > 49.);
  Scene.until s 50.5;
  Scene.forget s;
  Scene.until s 100.;
  Alcotest.(check int) "silent" 0 (telemetry s);
  Scene.send s Heartbeat;
  Scene.until s 101.;
  Alcotest.(check bool) "heard again" true (telemetry s > 0)

let another_port () =
  let s = Scene.make (Scene.settings source) in
  Scene.join s;
  Scene.announce ~port:7777 s;
  Scene.send s Heartbeat;
  Scene.until s 5.;
  let ports =
    List.filter_map
      (fun a -> if (a : Address.t).port = 6001 then None else Some a.port)
      (Vehicle_node.listeners ~at:5. (Scene.node s))
  in
  Alcotest.(check (list int)) "only the first counts" [] ports

let several () =
  let s = Scene.make (Scene.settings source) in
  Scene.join s;
  Scene.announce ~id:0x4001 ~port:7001 s;
  Scene.send ~id:0x4001 s Heartbeat;
  Alcotest.(check int) "both are told" 2 (List.length (Vehicle_node.listeners ~at:0. (Scene.node s)));
  Scene.forget s;
  Scene.start s 1 "p";
  let relayed (h : Scene.heard) = h.packet.src = Scene.console in
  Alcotest.(check int) "requests are sent on" 1 (List.length (List.filter relayed (Scene.heard s)))

let stamps () =
  let s = Scene.make (Scene.settings source) in
  Scene.join s;
  Scene.start s 1 "p";
  Scene.until s 20.;
  let own (h : Scene.heard) = if h.packet.src = Scene.vehicle then Some h.packet.timestamp else None in
  let stamps = List.filter_map own (Scene.heard s) in
  Alcotest.(check bool) "each later than the one before" true (stamps = List.sort_uniq Float.compare stamps)

let addressed () =
  let s = Scene.make (Scene.settings source) in
  Scene.join s;
  let starts dst =
    Scene.forget s;
    Scene.start ~dst s 1 "p";
    List.length (Scene.activities s)
  in
  Alcotest.(check (list int)) "own, broadcast, another, nobody" [ 1; 1; 0; 0 ]
    (List.map starts [ Scene.vehicle; Header.broadcast; 0x1B; Header.nobody ])

let entities () =
  let s = Scene.make (Scene.settings source) in
  Scene.join s;
  Scene.send s (Entity_list { op = Query; list = "" });
  let report (h : Scene.heard) =
    match h.packet with
    | { content = Message (Entity_list { op = Report; list }); dst; _ } when dst = Scene.console -> Some list
    | _ -> None
  in
  match List.filter_map report (Scene.heard s) with
  | [ list ] ->
    let names = List.map fst (Tuples.of_string list) in
    Alcotest.(check bool) "payload" true (List.mem "DVL" names && List.mem "Sidescan" names)
  | reports -> Alcotest.failf "%d reports" (List.length reports)

let battery () =
  let s = Scene.make (Scene.settings source) in
  Scene.join s;
  Scene.until s 0.;
  let level (h : Scene.heard) =
    match h.packet.content with Message (Fuel_level f) -> Some f.value | Message _ | Unknown _ -> None
  in
  Alcotest.(check (list (float 1e-3))) "percent" [ 80. ] (List.filter_map level (Scene.heard s))

(* EstimatedState is a place and a displacement: both together are where the vehicle is. *)
let moves () =
  let s = Scene.make (Scene.settings ~speed:10. (source ^ "\nplan 'p', { duration 10.min }")) in
  Scene.join s;
  Scene.start s 1 "p";
  Scene.until s 30.;
  let check (h : Scene.heard) =
    match h.packet.content with
    | Message (Estimated_state e) ->
      let position latitude longitude : Dolphin_geo.Position.t = { latitude; longitude; height = 0. } in
      let reference = position (Dolphin_geo.Angle.degrees e.lat) (Dolphin_geo.Angle.degrees e.lon) in
      let there = Dolphin_geo.Wgs84.displace reference ~north:e.x ~east:e.y in
      let truth = Vehicle_node.position ~at:h.time (Scene.node s) in
      if Dolphin_geo.Wgs84.distance there truth > 0.1 then Alcotest.failf "not there at %g" h.time;
      Some (Float.hypot e.x e.y)
    | Message _ | Unknown _ -> None
  in
  let distances = List.filter_map check (Scene.heard s) in
  Alcotest.(check bool) "gets about" true (List.exists (fun d -> d > 50.) distances)

let vanishes () =
  let s = Scene.make (Scene.settings ("vehicle 'a', { type 'UUV'; joins 15; leaves 100; drops 40, 20 }")) in
  Scene.join s;
  Scene.until s 14.9;
  Alcotest.(check int) "not yet there" 0 (List.length (Scene.heard s));
  Scene.join s;
  Scene.until s 15.;
  Scene.join s;
  let rec go time =
    if time < 120. then begin
      Scene.until s time;
      Scene.send s Heartbeat;
      go (time +. 1.)
    end
  in
  go 16.;
  let silent from until =
    not (List.exists (fun (h : Scene.heard) -> from <= h.time && h.time < until) (Scene.heard s)) in
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
    case "tells its position by a reference and offsets" moves;
    case "vanishes and returns" vanishes ]
