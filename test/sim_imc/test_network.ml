open Dolphin_imc
open Dolphin_sim_imc
open Lwt.Infix

let case name run = Alcotest.test_case name `Quick run

(* {1 A console} *)

type console = {
  id : int;
  discovery : Lwt_unix.file_descr;
  data : Lwt_unix.file_descr;
  data_port : int;
  mutable announced : Packet.t list;            (* latest first, as below *)
  mutable heard : Packet.t list;
}

let localhost port = Unix.ADDR_INET (Unix.inet_addr_loopback, port)

let bound port =
  let socket = Lwt_unix.socket PF_INET SOCK_DGRAM 0 in
  Lwt.map (fun () -> socket) (Lwt_unix.bind socket (localhost port))

let port_of socket =
  match Lwt_unix.getsockname socket with ADDR_INET (_, port) -> port | ADDR_UNIX _ -> Alcotest.fail "not a UDP socket"

let rec first_free port last =
  if port > last then Alcotest.fail "no free discovery port";
  Lwt.catch (fun () -> bound port) (function
      | Unix.Unix_error (EADDRINUSE, _, _) -> first_free (port + 1) last
      | error -> Lwt.fail error)

let send c socket port ~dst message =
  let packet = Packet.make ~src:c.id ~src_ent:1 ~dst ~timestamp:(Unix.gettimeofday ()) message in
  match Packet.encode packet with
  | Ok bytes ->
    Lwt_unix.sendto socket (Bytes.of_string bytes) 0 (String.length bytes) [] (localhost port) >|= fun (_ : int) -> ()
  | Error e -> Alcotest.failf "%a" Error.pp_encode e

let rec listen socket take =
  let buffer = Bytes.create 65536 in
  Lwt_unix.recvfrom socket buffer 0 65536 [] >>= fun (length, _) ->
  (match Packet.decode ~len:length (Bytes.to_string buffer) with
   | Ok packet -> take packet
   | Error e -> Alcotest.failf "from a vehicle: %a" Error.pp_decode e);
  listen socket take

let every seconds action =
  let rec go () = action () >>= fun () -> Lwt_unix.sleep seconds >>= go in
  go ()

(* {1 Both} *)

type world = { network : Network.t; console : console; mutable log : Yojson.Safe.t list  (** latest first *) }

let scenario source =
  match Dolphin_scenario.Scenario.read ~file:"test.fleet" source with
  | Ok s -> s
  | Error faults -> Alcotest.failf "%a" (Fmt.list (Dolphin_syntax.Diagnostic.pp ~source)) faults

let ports = 21100, 21104

let settings source =
  { (Network.default (scenario source)) with
    discovery_ports = ports; first_port = 21002; announce_period = 0.2; contact_period = 0.1; speed = 10. }

let announce c () =
  let services = Printf.sprintf "imc+udp://127.0.0.1:%d/" c.data_port in
  let message = Message.Announce { Message.Announce.default with sys_name = "ccu-test"; services } in
  Lwt_list.iter_s (fun port -> send c c.discovery port ~dst:0 message) (List.init 5 (fun i -> fst ports + i))

let beat w () =
  let to_vehicle (v : Network.vehicle) = send w.console w.console.data v.port ~dst:v.id Heartbeat in
  Lwt_list.iter_s to_vehicle (Network.vehicles w.network)

let create settings =
  match Network.create settings with Ok network -> network | Error why -> Alcotest.fail why

(* [with_world s run] fails after ten seconds. *)
let with_world settings run =
  let network = create settings in
  let body () =
    first_free (fst ports) (snd ports) >>= fun discovery ->
    bound 0 >>= fun data ->
    let console = { id = 0x4ABC; discovery; data; data_port = port_of data; announced = []; heard = [] } in
    let w = { network; console; log = [] } in
    let over, finish = Lwt.wait () in
    let life = Network.run ~log:(fun json -> w.log <- json :: w.log) ~until:over network in
    let background =
      [ listen discovery (fun p -> console.announced <- p :: console.announced);
        listen data (fun p -> console.heard <- p :: console.heard); every 0.2 (announce console);
        every 0.5 (beat w) ]
    in
    let test = Lwt_unix.with_timeout 10. (fun () -> run w) in
    Lwt.finalize (fun () -> Lwt.pick (test :: background)) (fun () ->
        Lwt.wakeup_later finish ();
        life >>= fun () -> Lwt.join [ Lwt_unix.close discovery; Lwt_unix.close data ])
  in
  Fun.protect ~finally:(fun () -> Network.close network) (fun () -> Lwt_main.run (body ()))

let rec wait_for w condition =
  if condition w then Lwt.return_unit else Lwt_unix.sleep 0.01 >>= fun () -> wait_for w condition

let request w (v : Network.vehicle) ?(op = Message.Plan_control.Op.Start) number plan_id =
  send w.console w.console.data v.port ~dst:v.id
    (Plan_control { Message.Plan_control.default with op; request_id = number; plan_id })

let hears_from (v : Network.vehicle) w =
  List.exists (fun (p : Packet.t) -> p.src = v.id && Packet.id p = Message.Plan_control_state.id) w.console.heard

let did w (v : Network.vehicle) =
  let open Yojson.Safe.Util in
  List.rev (List.filter_map
              (fun json ->
                 if to_string (member "vehicle" json) = v.name then Some (to_string (member "did" json)) else None)
              w.log)

let source =
  "vehicle 'a', { type 'UUV' }\nvehicle 'b', { type 'UAV' }\nvehicle 'c', { type 'UUV' }\n\
   plan 'p', { duration 5 }\nplan 'long', { duration 10.min }"

(* {1 Cases} *)

let finds_and_runs () =
  with_world (settings source) (fun w ->
      let vehicles = Network.vehicles w.network in
      wait_for w (fun w -> List.for_all (fun v -> hears_from v w) vehicles) >>= fun () ->
      let systems = List.sort_uniq compare (List.map (fun (p : Packet.t) -> p.src) w.console.announced) in
      let announced = List.filter (( <> ) w.console.id) systems in
      Alcotest.(check (list int)) "announced" [ 0x3001; 0x3002; 0x3003 ] announced;
      Lwt_list.iter_s (fun v -> request w v 1 "p") vehicles >>= fun () ->
      wait_for w (fun w -> List.for_all (fun v -> List.mem "completed" (did w v)) vehicles) >>= fun () ->
      List.iter (fun v -> Alcotest.(check (list string)) v.Network.name [ "started"; "completed" ] (did w v)) vehicles;
      let a = List.hd vehicles in
      request w a 2 "long" >>= fun () ->
      request w a ~op:Stop 3 "long" >>= fun () ->
      wait_for w (fun w -> List.mem "stopped" (did w a)))

(* Half of the requests arrive, and these are obeyed. *)
let loses () =
  with_world { (settings source) with faults = { Link_faults.none with loss = 0.5 } } (fun w ->
      let a = List.hd (Network.vehicles w.network) in
      wait_for w (hears_from a) >>= fun () ->
      Lwt_list.iter_s (fun number -> request w a number "long") (List.init 100 Fun.id) >>= fun () ->
      Lwt_unix.sleep 0.2 >|= fun () ->
      let started = List.length (did w a) in
      Alcotest.(check bool) (Printf.sprintf "%d of 100" started) true (30 < started && started < 70))

let floods () =
  with_world { (settings source) with flood = 500. } (fun w ->
      let a = List.hd (Network.vehicles w.network) in
      wait_for w (hears_from a) >>= fun () ->
      let of_sensors ids = List.filter (fun (p : Packet.t) -> p.src = a.id && List.mem (Packet.id p) ids) in
      let flood w = of_sensors [ 281; 254; 256; 257; 1 ] w.console.heard in
      wait_for w (fun w -> List.length (flood w) >= 300) >|= fun () ->
      let one = List.length (of_sensors [ 281 ] (flood w)) and all = List.length (flood w) in
      Alcotest.(check bool) "half of them from a sensor" true (abs ((2 * one) - all) < all / 5))

let no_port () =
  let others = List.init 5 (fun i -> create { (settings source) with discovery_ports = 21110 + i, 21110 + i }) in
  let error = Network.create { (settings source) with discovery_ports = 21110, 21114 } in
  List.iter Network.close others;
  match error with
  | Ok network -> Network.close network; Alcotest.fail "found a port"
  | Error why ->
    Alcotest.(check string) "says so"
      "none of the UDP ports 21110 to 21114, on which IMC systems find each other, is free" why

let tests =
  [ case "vehicles are found, run plans, and stop" finds_and_runs;
    case "a link loses requests" loses;
    case "sensors flood" floods;
    case "all discovery ports are taken" no_port ]
