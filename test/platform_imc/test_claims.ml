open Dolphin_imc
open Dolphin_platform_imc
module State = Message.Plan_control_state

let loopback = Unix.inet_addr_loopback
let vehicle = 0x1A
let ours = 0x4001
let theirs = 0x4002

let settings id name program port : Station.settings =
  { id; name; program; addresses = [ { host = loopback; port } ]; epoch = 0.; first_request = 0; payload = [];
    types = []; type_names = []; records = false; abort_after = None;
    run = ""; jitter = 0. }

let hear_bytes ~now bytes s = Station.datagram ~now ~from:loopback bytes s

let hear s (now, src, message) =
  let packet = Packet.make ~src ~dst:Header.nobody ~timestamp:now message in
  fst (hear_bytes ~now (Result.get_ok (Packet.encode packet)) s)

let announce name sys_type port =
  Message.Announce
    { Message.Announce.default with
      sys_name = name; sys_type; services = Printf.sprintf "imc+udp://127.0.0.1:%d/" port }

let says state plan_id = Message.Plan_control_state { State.default with state; plan_id }

let here = Message.Estimated_state { Message.Estimated_state.default with lat = 0.7; lon = 0.1 }
let located ~now s = hear s (now, vehicle, here)

(* Both consoles know each other and the vehicle, which is ready. *)
let introduced settings =
  List.fold_left hear (Station.create settings)
    [ (0., vehicle, announce "lauv-1" Uuv 6002); (0., ours, announce "ccu-7" Ccu 6001);
      (0., theirs, announce "ccu-8" Ccu 6003); (1., vehicle, here);
      (1., vehicle, says Ready "q") ]

let holder () = introduced (settings ours "ccu-7" "rendezvous.dol" 6001)
let other () = introduced (settings theirs "ccu-8" "b.dol" 6003)

(* What the outputs of one console bring to the other one, and its remarks. *)
let pass ~now outputs s =
  let deliver (s, remarks) : Station.output -> _ = function
    | Send { address = { port = 6003; _ }; bytes } ->
      let s, outputs = hear_bytes ~now bytes s in
      let remark : Station.output -> _ = function
        | Remark (v, text) -> Some (v ^ " " ^ text)
        | Send _ | Announce _ | Announce_to _ | Keep _ -> None
      in
      (s, remarks @ List.filter_map remark outputs)
    | Send _ | Announce _ | Announce_to _ | Keep _ | Remark _ -> (s, remarks)
  in
  List.fold_left deliver (located ~now s, []) outputs

let tick now s = fst (Station.tick ~now (located ~now s))

let obstacle ~now s =
  match List.find_opt (fun (x : Station.system) -> x.node.name = "lauv-1") (Station.systems ~now s) with
  | Some { state; _ } -> if state.connected then state.unready else Some "is not connected"
  | None -> Some "is not there"

(* As the program was told last. *)
let rec told s =
  match Station.take s with
  | None -> None
  | Some (event, s) -> (
      match told s, event with
      | None, Vehicle { id = "lauv-1"; unready; _ } -> Some unready
      | later, _ -> later)

let check name expected found = Alcotest.(check (option string)) name expected found
let case name f = Alcotest.test_case name `Quick f
let held = Some "is held by the program rendezvous.dol of ccu-7"

let claims =
  case "a vehicle that another console holds" (fun () ->
      let a, outputs = Station.bind ~now:2. [ "lauv-1" ] (holder ()) in
      let b, remarks = pass ~now:2. outputs (other ()) in
      check "held" held (obstacle ~now:2. b);
      Alcotest.(check (option (option string))) "the program is told" (Some held) (told b);
      Alcotest.(check (list string)) "no conflict" [] remarks;
      check "for the others" None (obstacle ~now:2. a);
      let _, outputs = Station.release ~now:3. [ "lauv-1" ] a in
      let b, _ = pass ~now:3. outputs b in
      check "released" None (obstacle ~now:3. b);
      Alcotest.(check (option (option string))) "the program is told of that" (Some None) (told b))

let repeated =
  case "claims are repeated, and forgotten with their console" (fun () ->
      let a, outputs = Station.bind ~now:2. [ "lauv-1" ] (holder ()) in
      let b, _ = pass ~now:2. outputs (other ()) in
      let _, outputs = Station.tick ~now:6. a in
      let b, _ = pass ~now:6. outputs b in
      check "still held" held (obstacle ~now:10. (tick 10. b));
      Alcotest.(check bool) "there is a time to look" true (Station.due b <= 11.);
      check "no word for 5 s" None (obstacle ~now:11. (tick 11. b)))

let conflict =
  case "two consoles that picked at the same time are told" (fun () ->
      let b, _ = Station.bind ~now:2. [ "lauv-1" ] (other ()) in
      let a, outputs = Station.bind ~now:2. [ "lauv-1" ] (holder ()) in
      let b, remarks = pass ~now:2. outputs b in
      let also = [ "lauv-1 also is held by the program rendezvous.dol of ccu-7" ] in
      Alcotest.(check (list string)) "told" also remarks;
      let _, again = Station.tick ~now:3. a in
      Alcotest.(check (list string)) "once" [] (snd (pass ~now:3. again b));
      check "ours all the same" None (obstacle ~now:3. b))

let strange =
  case "parameters that are no claim, and vehicles that nobody knows" (fun () ->
      let parameters name params = Message.Entity_parameters { name; params } in
      let vehicle_named value : Message.Entity_parameter.t = { name = "vehicle"; value } in
      let s = hear (other ()) (2., ours, parameters "Camera" [ vehicle_named "lauv-1" ]) in
      check "of a device" None (obstacle ~now:2. s);
      let s = hear s (2., ours, parameters Claim.name [ vehicle_named "lauv-2" ]) in
      check "of another" None (obstacle ~now:2. s);
      let s = hear s (2., ours, parameters Claim.name [ vehicle_named "lauv-1" ]) in
      check "of no program" (Some "is held by ccu-7") (obstacle ~now:2. s))

let resting =
  case "a vehicle that was busy must be ready for a second" (fun () ->
      let s = hear (other ()) (2., vehicle, says Executing "t1") in
      check "busy" (Some "runs plan t1") (obstacle ~now:2. s);
      let s = hear s (5., vehicle, says Ready "t1") in
      check "just ready" (Some "was busy a moment ago") (obstacle ~now:5.9 (tick 5.9 s));
      Alcotest.(check bool) "there is a time to look" true (Station.due s <= 6.);
      let s = tick 6. s in
      check "ready" None (obstacle ~now:6. s);
      Alcotest.(check (option (option string))) "the program is told" (Some None) (told s))

let between =
  case "between two plans of another program it is not ready" (fun () ->
      let lives =
        [ (2., says Executing "t1"); (5., says Ready "t1"); (5.001, says Initializing "t1");
          (5.002, says Executing "t2"); (8., says Ready "t2"); (8.001, says Initializing "t2");
          (8.002, says Executing "t3") ]
      in
      let one s (now, message) =
        let s = tick now (hear s (now, vehicle, message)) in
        Alcotest.(check bool) (Printf.sprintf "at %g" now) true (obstacle ~now s <> None);
        s
      in
      ignore (List.fold_left one (other ()) lives))

(* They would answer each other without end. *)
let several_links =
  case "a console that is heard from each of its addresses is met once" (fun () ->
      let services port = Printf.sprintf "imc+udp://127.0.0.1:%d/;imc+udp://192.0.2.2:%d/" port port in
      let announce (s, greetings) (now, from, port) =
        let content =
          Message.Announce
            { Message.Announce.default with sys_name = "ccu-8"; sys_type = Ccu; services = services port } in
        let packet = Packet.make ~src:theirs ~dst:Header.nobody ~timestamp:now content in
        let s, outputs = Station.datagram ~now ~from (Result.get_ok (Packet.encode packet)) s in
        let is_greeting : Station.output -> bool = function
          | Announce _ | Announce_to _ -> true
          | Send _ | Keep _ | Remark _ -> false
        in
        (s, List.exists is_greeting outputs :: greetings)
      in
      let lan = Unix.inet_addr_of_string "192.0.2.2" in
      let heard =
        [ (0., loopback, 6003); (0.1, lan, 6003); (1., loopback, 6003); (2., lan, 6003); (3., lan, 6004) ] in
      let _, greetings =
        List.fold_left announce (Station.create (settings ours "ccu-7" "rendezvous.dol" 6001), []) heard in
      Alcotest.(check (list bool)) "greeted" [ true; false; false; false; true ] (List.rev greetings))

let tests = ("claims", [ claims; repeated; conflict; strange; several_links; resting; between ])
