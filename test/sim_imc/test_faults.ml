open Dolphin_imc
open Dolphin_sim_imc

let case name run = Alcotest.test_case name `Quick run

let law ?(count = 300) name = Test_support.Property.case ~count name

(* {1 Links} *)

let faults : Link_faults.t = { loss = 0.3; duplication = 0.1; reordering = 0.2; delay = 0.01, 0.03 }
let some_delays = List.init 20_000 (fun number -> Link_faults.delays ~seed:1 ~link:"l" ~number faults)
let share list = float_of_int (List.length list) /. float_of_int (List.length some_delays)

let shares () =
  let check name expected list = Alcotest.(check (float 0.015)) name expected (share list) in
  check "lost" 0.3 (List.filter (( = ) []) some_delays);
  check "twice" 0.07 (List.filter (fun d -> List.length d = 2) some_delays);
  let arriving = List.filter (( <> ) []) some_delays in
  let late d = List.hd d > 0.03 +. 1e-9 in
  Alcotest.(check (float 0.015)) "held back" (0.2 *. 0.7 *. 0.9) (share (List.filter late arriving) *. 0.9);
  Alcotest.(check bool) "never early, never too late" true
    (List.for_all (List.for_all (fun d -> 0.01 <= d && d <= 0.13)) some_delays)

let again () =
  let delays seed = List.init 100 (fun number -> Link_faults.delays ~seed ~link:"l" ~number faults) in
  Alcotest.(check bool) "same seed, same luck" true (delays 1 = delays 1);
  Alcotest.(check bool) "another seed, another luck" false (delays 1 = delays 2);
  Alcotest.(check bool) "no faults" true (Link_faults.delays ~seed:1 ~link:"l" ~number:1 Link_faults.none = [ 0. ])

let bytes packet =
  match Packet.encode packet with Ok s -> s | Error e -> Alcotest.failf "%a" Error.pp_encode e

let from_console ?(dst = Harness.vehicle) message =
  bytes (Packet.make ~src:Harness.console ~src_ent:1 ~dst ~timestamp:Harness.epoch message)

let announcement =
  from_console ~dst:0
    (Announce { Message.Announce.default with sys_name = "ccu-test"; services = "imc+udp://127.0.0.1:6001/" })

let start number =
  from_console
    (Plan_control { Message.Plan_control.default with op = Start; request_id = number; plan_id = "p" })

let source = "vehicle 'a', { type 'UUV' }\nplan 'p', { duration 1 }"

(* A console sends [datagrams], each at a time: the messages that it gets in ten seconds, and the vehicle's deeds. *)
let exchange ?faults ~seed datagrams =
  let rec go r got did = function
    | [] -> List.rev got, List.rev did
    | (at, input) :: later as all -> (
        match Radio.due r with
        | Some due when due <= at && due <= 10. ->
          let sent, activities, r = Radio.advance ~at:due r in
          let got = List.rev_append (List.map (fun d -> due, d.Radio.bytes) sent) got in
          go r got (List.rev_append activities did) all
        | Some _ | None ->
          let sent, activities, r = input ~at r in
          let sent = List.map (fun d -> at, d.Radio.bytes) sent in
          go r (List.rev_append sent got) (List.rev_append activities did) later)
  in
  let receive channel bytes ~at r = Radio.receive ~at channel ~host:"127.0.0.1" bytes r in
  let end_ = 10., fun ~at:_ r -> [], [], r in
  let inputs = List.map (fun (at, channel, bytes) -> at, receive channel bytes) datagrams @ [ end_ ] in
  go (Radio.create ?faults ~seed (Harness.settings source)) [] [] inputs

let heartbeats =
  List.init 9 (fun i -> float_of_int i, Vehicle_node.Data, from_console Heartbeat)

let conversation =
  (0., Vehicle_node.Announcements, announcement) :: heartbeats @ [ 9.5, Vehicle_node.Data, start 1 ]

let both_ways () =
  let lossless, _ = exchange ~seed:1 conversation in
  let faults = { Link_faults.none with loss = 0.5 } in
  let got seed = List.length (fst (exchange ~faults ~seed conversation)) in
  let heard = List.filter (fun n -> n > 2) (List.init 40 got) in
  let mean = float_of_int (List.fold_left ( + ) 0 heard) /. float_of_int (List.length heard) in
  let ratio = mean /. float_of_int (List.length lossless) in
  Alcotest.(check bool) "some consoles are never heard" true (List.length heard < 40);
  Alcotest.(check bool) "of the rest, half is lost" true (0.35 < ratio && ratio < 0.55);
  let faults = { Link_faults.none with duplication = 1. } in
  let starts seed = List.length (snd (exchange ~faults ~seed conversation)) in
  Alcotest.(check int) "a request that comes twice is obeyed twice" 2 (starts 1)

let overtaken () =
  let faults = { Link_faults.none with reordering = 0.3 } in
  let got, _ = exchange ~faults ~seed:3 conversation in
  let stamp (_, bytes) = match Packet.decode bytes with Ok p -> p.timestamp | Error _ -> nan in
  let stamps = List.map stamp got in
  Alcotest.(check bool) "time stamps tell" false (stamps = List.sort Float.compare stamps);
  let lossless, _ = exchange ~seed:3 conversation in
  let late = List.length lossless - List.length got in
  Alcotest.(check bool) "nothing is lost, but for what is still under way" true (late >= 0 && late < 20)

let delayed () =
  let got, _ = exchange ~faults:{ Link_faults.none with delay = 0.2, 0.2 } ~seed:1 conversation in
  match List.find_opt (fun (_, bytes) -> String.length bytes = 22) got with
  | Some (at, _) -> Alcotest.(check (float 1e-6)) "there and back" 0.4 at
  | None -> Alcotest.fail "no heartbeat"

(* {1 Hostile bytes} *)

(* A change may write what is there already, and of two one may undo the other. *)
let mutated =
  let open QCheck2.Gen in
  let base = oneofl [ announcement; start 1; from_console Heartbeat; from_console Abort ] in
  let change = triple (0 -- 200) char bool in
  let apply s (at, c, cut) =
    if s = "" then s
    else if cut then String.sub s 0 (at mod String.length s)
    else String.mapi (fun i d -> if i = at mod String.length s then c else d) s
  in
  let damaged packet changes =
    let bytes = List.fold_left apply packet changes in
    if String.equal bytes packet then "" else bytes
  in
  map2 damaged base (list_size (1 -- 3) change)

let hostile datagrams =
  let timed = List.mapi (fun i bytes -> float_of_int i *. 0.01, Vehicle_node.Data, bytes) datagrams in
  let _, activities = exchange ~seed:1 timed in
  activities = []

(* {1 Any requests} *)

type action = Wait of float | Start of string | Inline of Message.Maneuver.t | Stop | Abort | Beat

let print_action = function
  | Wait t -> Printf.sprintf "wait %g" t
  | Start p -> "start " ^ p
  | Inline m -> Format.asprintf "inline %a" Message.pp (Maneuver m)
  | Stop -> "stop"
  | Abort -> "abort"
  | Beat -> "beat"

let maneuver =
  let open QCheck2.Gen in
  let any = oneof [ float; float_range (-1.) 1.; oneofl [ 0.; 1e30; nan; infinity ] ] in
  oneof
    [ map3 (fun lat lon speed -> Message.Maneuver.Goto { Message.Goto.default with lat; lon; speed }) any any any;
      map3
        (fun width hstep length ->
           Message.Maneuver.Rows { Message.Rows.default with width; hstep; length; alternation = 100 })
        any any any;
      map2
        (fun duration speed ->
           Message.Maneuver.Station_keeping { Message.Station_keeping.default with duration; speed })
        (0 -- 300) any;
      map
        (fun points ->
           let point (x, y) = { Message.Path_point.x; y; z = 0. } in
           Message.Maneuver.Follow_path { Message.Follow_path.default with points = List.map point points; speed = 3. })
        (list_size (0 -- 5) (pair any any)) ]

let action =
  let open QCheck2.Gen in
  frequency
    [ 6, map (fun t -> Wait t) (float_range 0. 100.); 4, map (fun p -> Start p) (oneofl [ "p"; "q"; "r"; "s"; "" ]);
      3, map (fun m -> Inline m) maneuver; 2, return Stop; 1, return Abort; 2, return Beat ]

let act s number = function
  | Wait t -> Harness.until s (Harness.now s +. t)
  | Start p -> Harness.start s number p
  | Inline m -> Harness.start ~arg:(Maneuver m) s number "i"
  | Stop -> Harness.stop s number
  | Abort -> Harness.send s Abort
  | Beat -> Harness.send s Heartbeat

let fleet =
  "vehicle 'a', { type 'UUV'; battery 10.percent; drain 100.percent; drops 50, 20 }\nplan 'p', { duration 5, 50 }\n\
   plan 'q', { duration 20; mayFail 50.percent }\nplan 'r', { only 'UAV' }"

(* Each plan that is started ends once, or runs. *)
let rec is_well_formed running : Activity.t list -> bool = function
  | [] -> true
  | Started { instead; request; _ } :: rest -> instead = running && is_well_formed (Some request.plan) rest
  | Refused { instead; _ } :: rest ->
    (instead = None || instead = running) && is_well_formed (if instead = None then running else None) rest
  | (Completed { plan; _ } | Failed { request = { plan; _ }; _ }) :: rest ->
    running = Some plan && is_well_formed None rest
  | (Stopped { plan; _ } | Aborted { plan; _ } | Blocked { plan }) :: rest -> plan = running && is_well_formed None rest
  | Lost { request = { plan; _ } } :: rest -> running = Some plan && is_well_formed None rest
  | (Ignored _ | Unblocked) :: rest -> is_well_formed running rest

let any_requests (speed, actions) =
  let s = Harness.make (Harness.settings ~speed ~blocks:[ 30., 10.; 200., 5. ] ~losses:[ 20.; 90.; 205. ] fleet) in
  Harness.join s;
  List.iteri (act s) actions;
  is_well_formed None (Harness.activities s)

let tests =
  [ case "loses, doubles and holds back so many" shares;
    case "is the same again" again;
    case "is bad both ways" both_ways;
    case "lets packets overtake" overtaken;
    case "is late" delayed;
    law ~count:200 "takes broken packets for nothing" QCheck2.Gen.(list_size (1 -- 20) mutated)
      ~print:QCheck2.Print.(list (fun s -> String.escaped s)) hostile;
    law "ends once what it starts, whatever it is told"
      QCheck2.Gen.(pair (oneofl [ 1.; 0.3; 7.; 100. ]) (list_size (1 -- 40) action))
      ~print:QCheck2.Print.(pair float (list print_action)) any_requests ]
