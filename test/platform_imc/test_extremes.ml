open Dolphin_imc
open Dolphin_platform_imc
module State = Message.Plan_control_state

let vehicle = 0x1A
let own = 0x4ABC
let loopback = Unix.inet_addr_loopback
let epoch = 1.79e9

let settings : Station.settings =
  { id = own; name = "ccu-test"; program = ""; addresses = [ { host = loopback; port = 6001 } ]; epoch;
    first_request = 0; payload = []; types = []; type_names = []; records = false; abort_after = None;
    run = ""; jitter = 0. }

let packet ?(stamp = fun x -> x) ~now ?(dst = Header.nobody) message =
  Result.get_ok (Packet.encode (Packet.make ~src:vehicle ~dst ~timestamp:(stamp (epoch +. now)) message))

let hear s (now, bytes) = fst (Station.datagram ~now ~from:loopback bytes s)

let announce =
  Message.Announce
    { Message.Announce.default with
      sys_name = "lauv-1"; sys_type = Uuv; lat = 0.7; services = "imc+udp://127.0.0.1:6002/" }

let says ?(outcome = State.Last_outcome.None) state plan_id =
  Message.Plan_control_state { State.default with state; plan_id; last_outcome = outcome; plan_progress = 50. }

let mode op_mode = Message.Vehicle_state { Message.Vehicle_state.default with op_mode }
let reply info = Message.Plan_control { Message.Plan_control.default with type_ = Success; plan_id = "p"; info }
let here = Message.Estimated_state { Message.Estimated_state.default with lat = 0.7; lon = 0.1 }

(* All that a station reads, as the vehicle says it while it executes plan p; the request to start has number 1 more
   than this. *)
let said : Message.t list =
  [ announce; Heartbeat; here; mode Maneuver; says Executing "p"; reply "1: executing maneuver";
    Fuel_level { Message.Fuel_level.default with value = 50. };
    Log_book_entry { Message.Log_book_entry.default with text = "x" }; Entity_list { op = Report; list = "a=1" };
    Entity_parameters { name = "x"; params = [] } ]
  @ List.filter_map (fun name -> Measurement.to_message name 1.) Measurement.names

(* {1 Runs} *)

(* When plan p, begun at 1 s, is heard to be done at 20 s, or why not; its end comes at 20 s. *)
let ended injected =
  let s = List.fold_left hear (Station.create settings)
      [ (0., packet ~now:0. announce); (0.5, packet ~now:0.5 (says Ready "q")); (0.6, packet ~now:0.6 (mode Service)) ]
  in
  let s, _ = Station.start ~now:1. "lauv-1" { name = "p"; plan = None; task_site = 0 } s in
  let usual from until =
    List.concat
      (List.init (until - from) (fun i ->
           let now = float_of_int (from + i) in
           [ (now, packet ~now (says Executing "p")); (now +. 0.1, packet ~now:(now +. 0.1) (mode Maneuver)) ]))
  in
  let s = List.fold_left hear s (usual 2 10) in
  let s = List.fold_left hear s (List.map (fun bytes -> (10.05, bytes)) injected) in
  let s = List.fold_left hear s (usual 11 20) in
  let progress = Station.plan "lauv-1" s in
  let rec events s =
    match Station.take s with
    | Some (Task_done _, s) -> "done" :: events s
    | Some (Task_failed (_, why), s) -> ("failed: " ^ why) :: events s
    | Some ((Vehicle _ | Timer _ | Input _ | Quiet), s) -> events s
    | None -> []
  in
  let early = events s in
  let s = hear s (20., packet ~now:20. (says ~outcome:Success Ready "p")) in
  (early, events (fst (Station.tick ~now:20. s)), progress, s)

let is_finite_progress (p : Execution.progress option) =
  let is_share x = Float.is_finite x && x >= 0. in
  match p with
  | Some { share; remaining; _ } ->
    Option.fold ~none:true ~some:is_share share && Option.fold ~none:true ~some:is_share remaining
  | None -> false

let check what injected =
  let early, late, progress, s = ended injected in
  (match early, late with
   | [], ([ "done" ] | [ "done"; _ ]) -> ()
   | _, _ -> Alcotest.failf "%s: %s, then %s" what (String.concat ", " early) (String.concat ", " late));
  if not (is_finite_progress progress) then Alcotest.failf "%s: strange progress" what;
  List.iter
    (fun (x : Station.system) ->
       (* A run whose journal cannot be read is not resumed. *)
       match Dolphin_trace.Entry.(of_string (to_string (Vehicle { time = 0.; state = x.state }))) with
       | Ok _ -> ()
       | Error why -> Alcotest.failf "%s: a journal with it cannot be read: %s" what why)
    (Station.systems ~now:20. s)

(* {1 Extreme numbers} *)

let extremes = [ nan; infinity; neg_infinity; 1e300; -1e300; 1e17; -1e17; 1e38; max_float; min_float; 4e9; -4e9; -1. ]

let stamps =
  Alcotest.test_case "time stamps" `Quick (fun () ->
      let shifts = [ 0.; 6.; 29.; -29.; 43200.; -43200.; 86401.; -86401.; 1e6; -1e6 ] in
      List.iter
        (fun message ->
           let try_stamp x = check (Printf.sprintf "%s at %g" (Message.name message) x)
               [ packet ~stamp:(fun _ -> x) ~now:10.05 message ] in
           List.iter try_stamp extremes;
           List.iter (fun shift -> try_stamp (epoch +. 10.05 +. shift)) shifts)
        said)

let size : Definition.scalar -> int = function U8 | I8 -> 1 | U16 | I16 -> 2 | U32 | I32 | F32 -> 4 | I64 | F64 -> 8

(* What the field of so many bytes may be, as little-endian bytes. *)
let patterns (scalar : Definition.scalar) =
  let bytes n set = let b = Bytes.create n in set b; Bytes.to_string b in
  let of_float = function
    | Definition.F32 -> fun x -> bytes 4 (fun b -> Bytes.set_int32_le b 0 (Int32.bits_of_float x))
    | _ -> fun x -> bytes 8 (fun b -> Bytes.set_int64_le b 0 (Int64.bits_of_float x))
  in
  match scalar with
  | F32 | F64 -> List.map (of_float scalar) extremes
  | U8 | U16 | U32 | I8 | I16 | I32 | I64 ->
    let n = size scalar in
    let top c = String.make (n - 1) (if c = '\x7F' then '\xFF' else '\x00') ^ String.make 1 c in
    [ String.make n '\x00'; String.make n '\xFF'; top '\x7F'; top '\x80' ]

(* Where the plain numbers of a payload are; behind an inline message nobody knows. *)
let numbers (m : Definition.message) payload =
  let rec go at found = function
    | [] -> found
    | (f : Definition.field) :: fields -> (
        match f.typ with
        | Number (scalar, Quantity _) -> go (at + size scalar) ((f.name, at, scalar) :: found) fields
        | Number (scalar, (Enumeration _ | Bits _)) -> go (at + size scalar) found fields
        | Text _ | Raw -> go (at + 2 + String.get_uint16_le payload at) found fields
        | Inline _ | List _ -> found)
  in
  go 0 [] m.fields

let seal bytes =
  let b = Bytes.of_string bytes in
  let n = Bytes.length b in
  Bytes.set_uint16_le b (n - 2) (Crc.arc (Bytes.to_string b) ~pos:0 ~len:(n - 2));
  Bytes.to_string b

let fields =
  Alcotest.test_case "each number of each message" `Quick (fun () ->
      let tried = ref 0 in
      let vary message =
        let bytes = packet ~now:10.05 message in
        let payload = String.sub bytes Header.size (String.length bytes - Header.overhead) in
        let definition = Option.get (Definition.find (Lazy.force Definition.builtin) (Message.id message)) in
        let put (name, at, _) pattern =
          let b = Bytes.of_string bytes in
          Bytes.blit_string pattern 0 b (Header.size + at) (String.length pattern);
          incr tried;
          check (Printf.sprintf "%s.%s = %S" definition.name name pattern) [ seal (Bytes.to_string b) ]
        in
        let put_all ((_, _, scalar) as field) = List.iter (put field) (patterns scalar) in
        List.iter put_all (numbers definition payload)
      in
      List.iter vary said;
      Alcotest.(check bool) "many were tried" true (!tried > 300))

let remarked =
  Alcotest.test_case "a stamp that is not taken is remarked on, once" `Quick (fun () ->
      let s = hear (Station.create settings) (0., packet ~now:0. announce) in
      let one (s, told) i =
        let now = 1. +. float_of_int i in
        let s, outputs =
          Station.datagram ~now ~from:loopback (packet ~stamp:(fun x -> x +. (1e6 *. float_of_int i)) ~now Heartbeat) s
        in
        let is_remark : Station.output -> bool = function
          | Remark _ -> true
          | Send _ | Announce _ | Announce_to _ | Keep _ -> false
        in
        (s, told @ List.filter is_remark outputs)
      in
      let _, told = List.fold_left one (s, []) [ 0; 1; 2; 3 ] in
      Alcotest.(check int) "remarks" 1 (List.length told))

let clock_set =
  Alcotest.test_case "a clock that was set by years is believed once it persists" `Quick (fun () ->
      let observe (c, _) (now, sent) = Vehicle_clock.observe ~now ~sent c in
      let before = List.init 5 (fun i -> (float_of_int i, 100. +. float_of_int i)) in
      let after = List.init 20 (fun i -> (10. +. float_of_int i, 1.79e9 +. float_of_int i)) in
      let _, sent = List.fold_left observe (Vehicle_clock.unknown, 0.) (before @ after) in
      Alcotest.(check (float 1e-3)) "goes on from the old one" 129. sent)

let tests = ("extreme numbers", [ stamps; fields; remarked; clock_set ])
