open Dolphin_imc

(* The recorded packets, in order. *)
let packets =
  lazy
    (let path = "../imc/data/lifecycle.imc" in
     let channel = open_in_bin path in
     let bytes = really_input_string channel (in_channel_length channel) in
     close_in channel;
     let rec split pos =
       if pos >= String.length bytes then []
       else
         match Header.read ~pos bytes with
         | Error e -> Alcotest.failf "%s: %a" path Error.pp_decode e
         | Ok header -> (
             match Packet.decode_after ~pos header bytes with
             | Error e -> Alcotest.failf "%s: %a" path Error.pp_decode e
             | Ok packet -> packet :: split (pos + Header.overhead + header.size))
     in
     split 0)

let console = 0x4ABC

(* The requests of the console, without the copies that the vehicle sent on; and the messages of the vehicle. *)
let requests, answers =
  let is_from id (p : Packet.t) = p.src = id in
  let of_console = lazy (List.sort_uniq compare (List.filter (is_from console) (Lazy.force packets))) in
  let is_request (p : Packet.t) =
    match p.content with
    | Message (Plan_control { type_ = Request; _ } | Abort) -> true
    | Message _ | Unknown _ -> false
  in
  ( lazy
    (List.sort
       (fun (p : Packet.t) (q : Packet.t) -> Float.compare p.timestamp q.timestamp)
       (List.filter is_request (Lazy.force of_console))),
    lazy (List.filter (is_from Harness.vehicle) (Lazy.force packets)) )

let source =
  "vehicle 'lauv-noptilus-1', { type 'UUV'; at 41.1850, -8.7062; speed 1.5 }"

let replay () =
  let s = Harness.make (Harness.settings ~strict:true source) in
  let first = (List.hd (Lazy.force requests)).timestamp in
  (* The clock of the vehicle is that of the console. *)
  let time_of (p : Packet.t) = 10. +. p.timestamp -. first in
  Harness.announce s;
  let ask (p : Packet.t) =
    Harness.beat_until s (time_of p);
    match p.content with Message m -> Harness.send s m | Unknown _ -> ()
  in
  Harness.send s Heartbeat;
  List.iter ask (Lazy.force requests);
  Harness.beat_until s (Harness.now s +. 200.);
  s

(* By message: different messages within a millisecond come in either order. *)
let of_kind kind lines = List.filter (fun line -> Harness.kind line = kind) lines

(* The names that the two consoles go by. *)
let renamed line =
  let parts = String.split_on_char ' ' line in
  String.concat " " (List.map (function "ccu-dolphin-0001" -> "ccu-test" | part -> part) parts)

let same kind () =
  let real = List.map renamed (of_kind kind (Harness.summarise (Lazy.force answers))) in
  let ours = of_kind kind (Harness.story (replay ())) in
  Alcotest.(check (list string)) "as the vehicle" real ours

(* Each writer's lines by themselves: two write at once. *)
let log_of writer () =
  let of_writer lines =
    let prefix = "log " ^ writer in
    let n = String.length prefix in
    List.filter (fun line -> String.length line > n && String.sub line 0 n = prefix) lines
  in
  let real = List.map renamed (of_writer (Harness.summarise (Lazy.force answers))) in
  Alcotest.(check (list string)) "as the vehicle" real (of_writer (Harness.story (replay ())))

(* The usual time between two messages of a kind: half of those times are shorter. *)
let period packets message =
  let is_it (p : Packet.t) = Packet.id p = Message.id message in
  let times = List.filter_map (fun (p : Packet.t) -> if is_it p then Some p.timestamp else None) packets in
  let rec gaps = function x :: (y :: _ as rest) -> (y -. x) :: gaps rest | [ _ ] | [] -> [] in
  let gaps = List.sort Float.compare (gaps (List.sort Float.compare times)) in
  List.nth gaps (List.length gaps / 2)

let periods () =
  let ours = List.map (fun (h : Harness.heard) -> h.packet) (Harness.heard (replay ())) in
  let ours = List.filter (fun (p : Packet.t) -> p.src = Harness.vehicle) ours in
  let compare_one (name, message) =
    Alcotest.(check (float 0.02)) name (period (Lazy.force answers) message) (period ours message)
  in
  List.iter compare_one
    [ "Announce", Message.Announce Message.Announce.default; "Heartbeat", Heartbeat;
      "PlanControlState", Plan_control_state Message.Plan_control_state.default;
      "VehicleState", Vehicle_state Message.Vehicle_state.default;
      "EstimatedState", Estimated_state Message.Estimated_state.default ]

let tests =
  [ Alcotest.test_case "replies" `Quick (same "reply");
    Alcotest.test_case "plan control states" `Quick (same "state");
    Alcotest.test_case "vehicle states" `Quick (same "vehicle");
    Alcotest.test_case "plans that are stored" `Quick (same "store");
    Alcotest.test_case "log book of the plan engine" `Quick (log_of "Plan.Engine");
    Alcotest.test_case "log book of the plan database" `Quick (log_of "Plan.DB");
    Alcotest.test_case "log book of the supervisor" `Quick (log_of "Supervisors.Vehicle");
    Alcotest.test_case "periods" `Quick periods ]
