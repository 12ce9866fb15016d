open Dolphin_imc
open Dolphin_platform_imc
open Dolphin_runtime
module State = Message.Plan_control_state
module Utf8 = Dolphin_utf8.Utf8

let loopback = Unix.inet_addr_loopback
let vehicle = 0x1A
let rival = 0x4002

let settings : Station.settings =
  { id = 0x4001; name = "ccu-7"; program = "p.dol"; addresses = [ { host = loopback; port = 6001 } ]; epoch = 0.;
    first_request = 0; payload = []; types = []; type_names = []; records = true; abort_after = None; run = "";
    jitter = 0. }

let check what text =
  if not (Utf8.line text == text) then QCheck2.Test.fail_reportf "%s: %S" what text

let check_json what (json : Yojson.Safe.t) =
  let rec texts : Yojson.Safe.t -> unit = function
    | `String s -> check what s
    | `List xs | `Tuple xs -> List.iter texts xs
    | `Assoc members -> List.iter (fun (name, x) -> check what name; texts x) members
    | `Variant (_, x) -> Option.iter texts x
    | `Null | `Bool _ | `Int _ | `Intlit _ | `Float _ -> ()
  in
  texts json

let check_state (state : Dolphin_semantics.World.vehicle_state) =
  check "its name" state.id;
  List.iter (check "payload") state.payload;
  Option.iter (check "why it is not ready") state.unready

let check_output : Station.output -> unit = function
  | Remark (v, text) -> check "a remark's vehicle" v; check "a remark" text
  | Keep (v, note) -> check "a note's vehicle" v; check_json "a note" (Durable_note.to_json note)
  | Send _ | Announce _ | Announce_to _ -> ()

let rec check_events s =
  match Station.take s with
  | None -> s
  | Some (event, s) ->
    (match event with
     | Platform.Vehicle state -> check_state state
     | Task_done v -> check "a vehicle that is done" v
     | Task_failed (v, why) -> check "a vehicle that failed" v; check "why" why
     | Timer _ | Input _ | Quiet -> ());
    check_events s

let carry_out (s, outputs) = List.iter check_output outputs; check_events s

let hear ?(dst = Header.nobody) ~now ~src message s =
  match Packet.encode (Packet.make ~src ~dst ~timestamp:(1000. +. now) message) with
  | Ok bytes -> carry_out (Station.datagram ~now ~from:loopback bytes s)
  | Error _ -> s

let announce name sys_type port =
  Message.Announce
    { Message.Announce.default with
      sys_name = name; sys_type; services = Printf.sprintf "imc+udp://127.0.0.1:%d/" port }

let says ?(outcome = State.Last_outcome.None) state plan_id =
  Message.Plan_control_state { State.default with state; plan_id; last_outcome = outcome }

(* What a vehicle and another console may say, with the texts [a] and [b] in it. *)
let sayings a b : (int * Message.t) list =
  let mode op_mode =
    Message.Vehicle_state { Message.Vehicle_state.default with op_mode; last_error = a; error_ents = b } in
  let reply type_ =
    Message.Plan_control
      { Message.Plan_control.default with type_; op = Start; request_id = 0x1A * 257; plan_id = "p"; info = a }
  in
  let log type_ = Message.Log_book_entry { Message.Log_book_entry.default with type_; context = b; text = a } in
  let parameters name params = Message.Entity_parameters { name; params } in
  let parameter name value : Message.Entity_parameter.t = { name; value } in
  [ (vehicle, says Executing a); (vehicle, says Ready b); (vehicle, mode Error); (vehicle, mode Service);
    (vehicle, Entity_list { op = Report; list = a ^ "=1;" ^ b ^ "=2" }); (vehicle, log Error); (vehicle, log Info);
    (vehicle, reply Failure); (vehicle, reply Success); (vehicle, parameters a [ parameter b a ]);
    (rival, parameters Claim.name [ parameter "program" a; parameter "vehicle" "lauv-1"; parameter "vehicle" b ]);
    (rival, announce b Ccu 6003); (0x1B, announce a Uuv 6004); (vehicle, announce a Uuv 6002) ]

let play (a, b, order) =
  let s = hear ~now:0. ~src:vehicle (announce "lauv-1" Uuv 6002) (Station.create settings) in
  let s = hear ~now:0.1 ~src:rival (announce "ccu-8" Ccu 6003) s in
  let s = hear ~now:0.2 ~src:vehicle (says Ready "q") s in
  let s = carry_out (Station.start ~now:0.5 "lauv-1" { name = "p"; plan = None; task_site = 0 } s) in
  let all = Array.of_list (sayings a b) in
  let one (s, now) i =
    let src, message = all.(i mod Array.length all) in
    let s = hear ~dst:settings.id ~now ~src message s in
    let s = carry_out (Station.tick ~now:(now +. 0.5) s) in
    List.iter
      (fun (x : Station.system) ->
         check "a system" x.node.name;
         check "an error" x.node.error;
         Option.iter (List.iter (check "an entity")) x.node.entities;
         check_state x.state)
      (Station.systems ~now s);
    (s, now +. 1.)
  in
  ignore (List.fold_left one (s, 1.) order);
  true

let texts =
  let open QCheck2.Gen in
  let piece =
    oneof
      [ string_size ~gen:char (int_bound 4); oneofl [ "\x1b[2J"; "\n"; "\x00"; "\xC2\x9B"; "\xED\xA0\x80"; "\xE7"; "\xC3\xA7" ];
        string_size ~gen:printable (int_bound 6) ]
  in
  map (String.concat "") (list_size (int_bound 5) piece)

let plays = QCheck2.Gen.(triple texts texts (list_size (int_range 5 30) (int_bound 1000)))

let drawn =
  Test_support.Property.case ~count:500 "no text that leaves is invalid, or has control characters"
    ~print:QCheck2.Print.(triple String.escaped String.escaped (list int)) plays play

let own_plans =
  Alcotest.test_case "plans whose names vehicles could not report" `Quick (fun () ->
      let s = hear ~now:0. ~src:vehicle (announce "lauv-1" Uuv 6002) (Station.create settings) in
      let s = hear ~now:0.2 ~src:vehicle (says Ready "q") s in
      let start name = fst (Station.start ~now:1. "lauv-1" { name; plan = None; task_site = 0 } s) in
      let rec failure s =
        match Station.take s with
        | None -> None
        | Some (Platform.Task_failed (_, why), _) -> Some why
        | Some (_, s) -> failure s
      in
      Alcotest.(check (option string)) "refused"
        (Some "the plan's name has control characters: vehicles would report another name") (failure (start "a\tb"));
      Alcotest.(check (option string)) "taken" None (failure (start "Operação 1")))

let tests = ("texts of datagrams", [ drawn; own_plans ])
