open Dolphin_imc
open Dolphin_platform_imc
module State = Message.Plan_control_state

let loopback = Unix.inet_addr_loopback
let elsewhere = Unix.inet_addr_of_string "192.0.2.7"

let settings : Station.settings =
  { id = 0x4001; name = "ccu-7"; program = "p.dol"; addresses = [ { host = loopback; port = 6001 } ]; epoch = 0.;
    first_request = 0; payload = []; types = []; type_names = []; records = true; abort_after = None; run = "";
    jitter = 0. }

(* The station, and what people were told, latest first. *)
let hear ?(from = loopback) ~now src message (s, told) =
  let packet = Packet.make ~src ~dst:Header.nobody ~timestamp:(1000. +. now) message in
  let s, outputs = Station.datagram ~now ~from (Result.get_ok (Packet.encode packet)) s in
  let remark : Station.output -> string option = function
    | Remark (v, text) -> Some (v ^ ": " ^ text)
    | Send _ | Announce _ | Announce_to _ | Keep _ -> None
  in
  (s, List.rev_append (List.filter_map remark outputs) told)

let announce ?(sys_type = Message.System_type.Uuv) name port =
  Message.Announce
    { Message.Announce.default with
      sys_name = name; sys_type; services = Printf.sprintf "imc+udp://0.0.0.0:%d/" port }

let ready = Message.Plan_control_state { State.default with state = Ready; plan_id = "q" }
let here = Message.Estimated_state { Message.Estimated_state.default with lat = 0.7; lon = 0.1 }
let start () = (Station.create settings, [])

let find ~now name (s, _) =
  List.find_opt (fun (x : Station.system) -> x.node.name = name) (Station.systems ~now s)

let unready ~now name s =
  match find ~now name s with Some x -> x.state.unready | None -> Some "is not known"

let address ~now name s =
  match find ~now name s with
  | Some { node = { address = Some a; _ }; _ } -> Format.asprintf "%a" Service.pp_address a
  | Some _ | None -> "nowhere"

let tick now (s, told) = (fst (Station.tick ~now s), told)
let text = Alcotest.(check (option string))
let strings = Alcotest.(check (list string))
let case name f = Alcotest.test_case name `Quick f

(* {1 A crowd} *)

let pretenders ?from ~now ~first count s =
  let one s i = hear ?from ~now (first + i) (announce (Printf.sprintf "fake-%d" (first + i)) 7000) s in
  List.fold_left one s (List.init count Fun.id)

let speaks ?(from = loopback) ~now src name port s =
  let s = hear ~from ~now src (announce name port) s in
  hear ~from ~now src ready (hear ~from ~now src here s)

let real_among ~first_ones ~rate ~from =
  (* Vehicles that are there already, 2,000 that only announce themselves, and one that comes then. *)
  let s = List.fold_left (fun s i -> speaks ~now:1. (0x10 + i) (Printf.sprintf "lauv-%d" i) (6002 + i) s) (start ())
      (List.init first_ones Fun.id) in
  let s = pretenders ?from ~now:2. ~first:0x1000 2000 s in
  let s = hear ~now:3. 0x80 (announce "lauv-late" 6050) s in
  (* It speaks a second later, while others go on to announce themselves. *)
  let s = pretenders ?from ~now:3.5 ~first:0x3000 rate s in
  let s = hear ~now:4. 0x80 ready (hear ~now:4. 0x80 here s) in
  let s = pretenders ?from ~now:4.5 ~first:0x8000 2000 s in
  let s = List.fold_left (fun s i -> hear ~now:5. (0x10 + i) here s) s (List.init first_ones Fun.id) in
  (hear ~now:5. 0x80 here s, first_ones)

let crowds = QCheck2.Gen.(triple (int_bound 20) (int_bound 1500) bool)

let hidden =
  Test_support.Property.case ~count:10 "2,000 announced ids do not hide vehicles"
    ~print:QCheck2.Print.(triple int int bool) crowds
    (fun (first_ones, rate, is_far) ->
       let (s, told), known = real_among ~first_ones ~rate ~from:(if is_far then Some elsewhere else None) in
       let names = "lauv-late" :: List.init known (Printf.sprintf "lauv-%d") in
       let missing = List.filter (fun name -> unready ~now:5. name (s, told) <> None) names in
       if missing <> [] then QCheck2.Test.fail_reportf "%s: %s" (List.hd missing)
           (Option.value (unready ~now:5. (List.hd missing) (s, told)) ~default:"");
       if List.length (Station.systems ~now:5. s) > Station.most_nodes then QCheck2.Test.fail_report "too many";
       if List.length told <> 1 then QCheck2.Test.fail_reportf "remarks: %s" (String.concat "; " told);
       true)

let wanted =
  case "what the program holds is never forgotten" (fun () ->
      let s = hear ~now:1. 0x10 (announce "lauv-0" 6002) (start ()) in
      let s = (fst (Station.bind ~now:1. [ "lauv-0" ] (fst s)), snd s) in
      let s = pretenders ~now:2. ~first:0x1000 6000 s in
      Alcotest.(check bool) "it is known" true (find ~now:2. "lauv-0" s <> None))

(* {1 One IMC address} *)

let clones =
  case "two systems with one IMC address on one host" (fun () ->
      let one ~now s = hear ~now 0x1A (announce "lauv-1" 6002) s in
      let other ~now s = hear ~now 0x1A (announce "lauv-1" 6003) s in
      let s = one ~now:0. (start ()) in
      let s = hear ~now:0.5 0x1A ready (hear ~now:0.5 0x1A here s) in
      text "one alone" None (unready ~now:1. "lauv-1" s);
      let s = other ~now:5. s in
      let s = one ~now:10. s in
      let s = hear ~now:14. 0x1A ready (hear ~now:14. 0x1A here (other ~now:14. s)) in
      text "not to be picked" (Some "shares its IMC address 0x001a with another system") (unready ~now:14. "lauv-1" s);
      let told =
        [ "lauv-1: two systems have the IMC address 0x001a: lauv-1 at 127.0.0.1:6003, and lauv-1 at 127.0.0.1:6002; \
           their messages cannot be told apart, so it cannot be picked" ]
      in
      strings "told, once" told (snd (other ~now:24. (one ~now:20. s)));
      let alone s now = hear ~now 0x1A ready (hear ~now 0x1A here (tick now (hear ~now 0x1A (announce "lauv-1" 6003) s))) in
      let s = List.fold_left alone s [ 25.; 30.; 35.; 40.; 45.; 50.; 55. ] in
      text "alone again" None (unready ~now:55. "lauv-1" s))

let restarted =
  case "a system that was restarted moves to its new port" (fun () ->
      let s = hear ~now:0. 0x1A (announce "lauv-1" 6002) (start ()) in
      let s = hear ~now:0.5 0x1A ready (hear ~now:0.5 0x1A here s) in
      let s = List.fold_left (fun s now -> hear ~now 0x1A (announce "lauv-1" 6003) s) s [ 10.; 20.; 30. ] in
      let s = hear ~now:30. 0x1A here s in
      Alcotest.(check string) "there" "127.0.0.1:6003" (address ~now:30. "lauv-1" s);
      text "it can be picked" None (unready ~now:30. "lauv-1" s);
      strings "nothing is told" [] (snd s))

let named_otherwise =
  case "two systems with one IMC address and two names" (fun () ->
      let s = hear ~now:0. 0x1A (announce "lauv-1" 6002) (start ()) in
      let s = hear ~from:elsewhere ~now:1. 0x1A (announce "lauv-2" 6002) s in
      strings "of another host"
        [ "lauv-1: two systems have the IMC address 0x001a: lauv-1 at 127.0.0.1:6002, and lauv-2 at 192.0.2.7:6002, \
           which is ignored" ]
        (snd s);
      let s = hear ~now:2. 0x1A ready (hear ~now:2. 0x1A here s) in
      text "the first can be picked" None (unready ~now:2. "lauv-1" s);
      let s = hear ~now:3. 0x1A (announce "lauv-3" 6003) s in
      Alcotest.(check int) "of the same host" 2 (List.length (snd s));
      text "it cannot be picked" (Some "shares its IMC address 0x001a with another system") (unready ~now:3. "lauv-1" s))

let one_name =
  case "two systems with one name" (fun () ->
      let s = hear ~now:0. 0x1A (announce "lauv-1" 6002) (start ()) in
      let again now s = hear ~from:elsewhere ~now 0x1B (announce "lauv-1" 6002) s in
      strings "told, once"
        [ "lauv-1: two systems have this name: 0x001a, which is lauv-1 at 127.0.0.1:6002, and 0x001b at 192.0.2.7, \
           which is ignored" ]
        (snd (again 2. (again 1. s))))

let renamed =
  case "a system that comes back under another name is known at once" (fun () ->
      let s = hear ~now:0. 0x1A (announce "lauv-1" 6002) (start ()) in
      let s = hear ~now:1. 0x1A (announce "lauv-xplore-1" 6002) s in
      Alcotest.(check string) "there" "127.0.0.1:6002" (address ~now:1. "lauv-xplore-1" s);
      Alcotest.(check string) "and not there" "nowhere" (address ~now:1. "lauv-1" s);
      strings "nothing is told" [] (snd s);
      let s = hear ~now:0. 0x1A (announce "lauv-1" 6002) (start ()) in
      let s = (fst (Station.bind ~now:0.5 [ "lauv-1" ] (fst s)), snd s) in
      let s = hear ~now:1. 0x1A (announce "lauv-xplore-1" 6002) s in
      Alcotest.(check string) "unless it is held" "127.0.0.1:6002" (address ~now:1. "lauv-1" s))

let tests = ("crowds", [ hidden; wanted; clones; restarted; named_otherwise; one_name; renamed ])
