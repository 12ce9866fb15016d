open Dolphin_imc
open Dolphin_platform_imc

let loopback = Unix.inet_addr_loopback
let elsewhere = Unix.inet_addr_of_string "203.0.113.9"

let settings : Station.settings =
  { id = Recording.console; name = "ccu-test"; program = ""; addresses = [ { host = loopback; port = 6001 } ]; epoch = 1.79e9;
    first_request = 0; payload = []; types = []; type_names = []; records = false; abort_after = None;
    run = ""; jitter = 0. }

let station () = Station.create settings

let hear ?(from = loopback) ?(now = 0.) bytes s = fst (Station.datagram ~now ~from bytes s)

(* All that is known, counters and events apart. *)
let knowledge s = List.map (fun (x : Station.system) -> x.node) (Station.systems ~now:0. s)

let inward = lazy (List.filter (fun (l : Recording.line) -> l.inward) (Lazy.force Recording.lines))

let informed =
  lazy
    (List.fold_left (fun s (l : Recording.line) -> hear ~now:l.time l.bytes s) (station ()) (Lazy.force inward))

let mutated random bytes =
  let b = Bytes.of_string bytes in
  let n = Bytes.length b in
  let anywhere () = Random.State.int random n in
  match Random.State.int random 5 with
  | 0 -> String.sub bytes 0 (anywhere ())
  | 1 -> bytes ^ String.sub bytes 0 (anywhere ())
  | 2 -> String.init (Random.State.int random 200) (fun _ -> Char.chr (Random.State.int random 256))
  | _ ->
    for _ = 0 to Random.State.int random 6 do
      Bytes.set b (anywhere ()) (Char.chr (Random.State.int random 256))
    done;
    Bytes.to_string b

(* DOLPHIN_LONG multiplies it. *)
let count = 100_000 * (match Sys.getenv_opt "DOLPHIN_LONG" with Some n -> int_of_string n | None -> 1)

let mutations =
  Alcotest.test_case (Printf.sprintf "%d mutated datagrams" count) `Quick (fun () ->
      let random = Random.State.make [| 5 |] in
      let originals = Array.of_list (List.map (fun (l : Recording.line) -> l.bytes) (Lazy.force Recording.lines)) in
      let before = Lazy.force informed in
      let known = knowledge before in
      let rec go i s =
        if i < count then begin
          let bytes = mutated random originals.(Random.State.int random (Array.length originals)) in
          let after = hear ~now:100. bytes s in
          match Packet.decode bytes with
          | Ok _ -> go (i + 1) s
          | Error _ ->
            if knowledge after <> known then Alcotest.failf "mutation %d changed something" i;
            if Station.waiting after <> Station.waiting s then Alcotest.failf "mutation %d made an event" i;
            go (i + 1) after
        end
        else s
      in
      let s = go 0 before in
      let total = List.fold_left (fun n (_, k) -> n + k) 0 (Station.dropped s) in
      Alcotest.(check bool) "counted" true (total > count / 4))

let sealed p = Result.get_ok (Packet.encode p)

(* Valid packets with random contents: anything may change, but nothing breaks, and what is kept stays small. *)
let valid =
  Alcotest.test_case "valid packets of many senders: bounded" `Quick (fun () ->
      let random = Random.State.make [| 6 |] in
      let announce src =
        sealed
          (Packet.make ~src ~dst:0 ~timestamp:(Random.State.float random 1e10)
             (Announce
                { Message.Announce.default with
                  sys_name = Printf.sprintf "v%d" src; sys_type = Uuv;
                  lat = Random.State.float random 8.; lon = nan;
                  services = "imc+udp://127.0.0.1:6002/;imc+udp://999.1.1.1:70000/;imc+udp://;;imc+udp://0.0.0.0:1/" }))
      in
      let rec go src s = if src > 20_000 then s else go (src + 1) (hear (announce src) s) in
      let s = go 1 (station ()) in
      let known = List.length (knowledge s) in
      (* A hundred are forgotten together. *)
      Alcotest.(check bool) "remembered" true (known <= Station.most_nodes && known >= Station.most_nodes - 100);
      Alcotest.(check bool) "time goes on" true (Station.due (fst (Station.tick ~now:1. s)) > 1.))

let strange_numbers =
  Alcotest.test_case "numbers that are none" `Quick (fun () ->
      let s = Lazy.force informed in
      let odd = [ nan; infinity; neg_infinity; 1e300; -1e300; 0. ] in
      let hear_odd s x =
        let state = { Message.Estimated_state.default with lat = x; lon = x; x; y = x; z = x; height = x } in
        let packets : Message.t list =
          [ Estimated_state state;
            Estimated_state { state with lat = 0.7; lon = 0. };
            Fuel_level { Message.Fuel_level.default with value = x };
            Estimated_state { state with vx = x; vy = -.x };
            Temperature { value = x };
            Plan_control_state { Message.Plan_control_state.default with plan_progress = x; plan_eta = min_int / 4 } ]
        in
        List.fold_left
          (fun s m ->
             match Packet.encode (Packet.make ~src:0x1A ~timestamp:x m) with Ok bytes -> hear bytes s | Error _ -> s)
          s packets
      in
      let s = List.fold_left hear_odd s odd in
      match Station.systems ~now:100. s with
      | [ { state; _ } ] ->
        Alcotest.(check bool) "battery" true (match state.battery with Some share -> share >= 0. && share <= 1. | None -> true);
        Alcotest.(check bool) "readings" true (List.for_all (fun (_, x) -> Float.is_finite x) state.readings);
        Alcotest.(check bool) "speed" true (match state.speed with Some x -> Float.is_finite x && x >= 0. | None -> true);
        Alcotest.(check bool) "position" true (Float.is_finite state.position.latitude)
      | sights -> Alcotest.failf "%d systems" (List.length sights))

let measurements =
  Alcotest.test_case "what a vehicle measures" `Quick (fun () ->
      let tell s (time, m) =
        match Packet.encode (Packet.make ~src:0x1A ~timestamp:time m) with
        | Ok bytes -> hear bytes s
        | Error _ -> Alcotest.fail "no packet"
      in
      let stamp (l : Recording.line) =
        match Packet.decode l.bytes with Ok p when p.src = 0x1A -> p.timestamp | Ok _ | Error _ -> 0.
      in
      let base = 0.1 +. List.fold_left (fun t l -> Float.max t (stamp l)) 0. (Lazy.force inward) in
      let moving = { Message.Estimated_state.default with lat = 0.7; vx = 3.; vy = 4.; vz = 5. } in
      let told : (float * Message.t) list =
        [ (base, Temperature { value = 14.5 }); (base +. 1., Salinity { value = 35. });
          (base +. 2., Estimated_state moving);
          (base +. 3., Temperature { value = 13.5 }); (base +. 4., Temperature { value = nan });
          (base +. 2.5, Salinity { value = 34. }); (base +. 2.2, Salinity { value = 33. }) ]
      in
      let s = List.fold_left tell (Lazy.force informed) told in
      match Station.systems ~now:100. s with
      | [ { state; _ } ] ->
        Alcotest.(check (list (pair string (float 0.)))) "the last of each" [ ("Salinity", 34.); ("Temperature", 13.5) ]
          state.readings;
        Alcotest.(check (option (float 1e-6))) "over the ground" (Some 5.) state.speed
      | sights -> Alcotest.failf "%d systems" (List.length sights))

(* DUNE says -1 of what it does not know. *)
let levels =
  Alcotest.test_case "depths and altitudes" `Quick (fun () ->
      let levels_of (n : Node.t) = (n.depth, n.altitude) in
      let heard kind (depth, alt) =
        let announce = { Message.Announce.default with sys_name = "v"; sys_type = kind } in
        let packet time m = Packet.make ~src:0x1A ~timestamp:time m in
        let n =
          Node.make ~now:0. ~from:Unix.inet_addr_loopback ~request:1 (packet 3e9 (Announce announce)) announce in
        let state = { Message.Estimated_state.default with lat = 0.7; depth; alt } in
        levels_of (fst (Node.hear ~now:1. ~own:1 (packet (3e9 +. 1.) (Estimated_state state)) n))
      in
      let says name expected found =
        Alcotest.(check (pair (option (float 0.)) (option (float 0.)))) name expected found in
      says "what dives" (Some 12., None) (heard Uuv (12., 80.));
      says "what floats" (Some 0., None) (heard Usv (0., 80.));
      says "what flies" (None, Some 80.) (heard Uav (0., 80.));
      says "unknown depth" (None, None) (heard Uuv (-1., 80.));
      says "unknown altitude" (None, None) (heard Uav (-1., -1.));
      says "no number" (None, None) (heard Uuv (nan, infinity)))

(* {1 Spoofing} *)

let spoofed =
  Alcotest.test_case "datagrams from an address that is not the vehicle's" `Quick (fun () ->
      let s = Lazy.force informed in
      let known = knowledge s in
      let s' =
        List.fold_left (fun s (l : Recording.line) -> hear ~from:elsewhere ~now:70. l.bytes s) s (Lazy.force inward)
      in
      Alcotest.(check bool) "nothing changed" true (knowledge s' = known);
      Alcotest.(check (option int)) "counted"
        (Some (List.length (List.filter (fun (l : Recording.line) ->
             match Recording.message l with
             | Announce _ | Heartbeat | Estimated_state _ | Vehicle_state _ | Plan_control_state _ | Fuel_level _
             | Entity_list _
             | Log_book_entry _ -> true
             | Plan_control c -> c.type_ <> Request
             | m -> Measurement.of_message m <> None) (Lazy.force inward))))
        (List.assoc_opt "foreign address" (Station.dropped s')))

let announcement ?(services = "imc+udp://203.0.113.9:6002/") ?(sys_type = Message.System_type.Uuv) name =
  sealed
    (Packet.make ~src:0x1A ~dst:0 ~timestamp:1.8e9
       (Announce { Message.Announce.default with sys_name = name; sys_type; services }))

let addresses s =
  List.map
    (fun (x : Station.system) -> Option.map (Format.asprintf "%a" Service.pp_address) x.node.address)
    (Station.systems ~now:0. s)

let moved =
  Alcotest.test_case "a vehicle moves only after it has been absent" `Quick (fun () ->
      let s = Lazy.force informed in
      let bytes = announcement Recording.vehicle in
      let soon = hear ~from:elsewhere ~now:80. bytes s and late = hear ~from:elsewhere ~now:120. bytes s in
      Alcotest.(check (list (option string))) "soon" [ Some "127.0.0.1:6002" ] (addresses soon);
      Alcotest.(check (list (option string))) "late" [ Some "203.0.113.9:6002" ] (addresses late))

let unknown =
  Alcotest.test_case "systems that have not announced" `Quick (fun () ->
      let mute (l : Recording.line) = match Recording.message l with Announce _ -> false | _ -> true in
      let s =
        List.fold_left (fun s (l : Recording.line) -> hear l.bytes s) (station ())
          (List.filter mute (Lazy.force inward))
      in
      Alcotest.(check int) "known" 0 (List.length (knowledge s)))

let types =
  Alcotest.test_case "types that IMC does not know" `Quick (fun () ->
      let kind ?(types = []) ?(type_names = []) sys_type =
        let s = Station.create { settings with types; type_names } in
        List.map (fun (x : Station.system) -> x.state.kind)
          (Station.systems ~now:0. (hear (announcement ~sys_type "seacon-1") s))
      in
      let check what expected kind = Alcotest.(check (list string)) what [ expected ] kind in
      check "its number" "9" (kind (Other 9));
      check "its name in IMC.xml" "ROV" (kind ~type_names:[ (2, "X"); (9, "ROV") ] (Other 9));
      check "as it announces" "UUV" (kind ~type_names:[ (2, "X") ] Uuv);
      check "as the user says" "ROV" (kind ~types:[ ("seacon-1", "ROV") ] Uuv);
      check "another vehicle" "UUV" (kind ~types:[ ("seacon-2", "ROV") ] Uuv))

let tests = ("hostile", [ mutations; valid; strange_numbers; measurements; levels; spoofed; moved; unknown; types ])
