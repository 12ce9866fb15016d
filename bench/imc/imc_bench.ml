(* How many packets a second the codec takes: imc_bench FLOOD LIFECYCLE, two files of packets.

   Each figure is the best of several rounds over packets in memory, one core, no socket. *)

open Dolphin_imc

let read path =
  let channel = open_in_bin path in
  Fun.protect
    ~finally:(fun () -> close_in channel)
    (fun () -> really_input_string channel (in_channel_length channel))

let get = function Ok value -> value | Error e -> failwith (Format.asprintf "%a" Error.pp_decode e)

let packets path =
  let s = read path in
  let rec split pos packets =
    if pos = String.length s then List.rev packets
    else
      let length = Header.overhead + (get (Header.read ~pos s)).size in
      split (pos + length) (String.sub s pos length :: packets)
  in
  Array.of_list (split 0 [])

(* [measure name packets f] applies [f] to all packets, for a quarter of a second in each of 5 rounds. *)
let measure name packets f =
  let round () =
    let start = Unix.gettimeofday () and allocated = Gc.minor_words () in
    let rec repeat n =
      Array.iter (fun p -> ignore (Sys.opaque_identity (f p))) packets;
      let elapsed = Unix.gettimeofday () -. start in
      if elapsed < 0.25 then repeat (n + 1)
      else
        let total = float ((n + 1) * Array.length packets) in
        (total /. elapsed, (Gc.minor_words () -. allocated) /. total)
    in
    repeat 0
  in
  let rate, words = List.fold_left max (0., 0.) (List.init 5 (fun _ -> round ())) in
  let bytes = Array.fold_left (fun n p -> n + String.length p) 0 packets in
  Printf.printf "%-42s %6.2f M/s  %6.0f ns  %5.0f words  (%d packets of %d bytes)\n%!" name (rate /. 1e6)
    (1e9 /. rate) words (Array.length packets)
    (bytes / Array.length packets)

let only ids packets =
  let wanted s = List.mem (get (Header.read s)).id ids in
  Array.of_list (List.filter wanted (Array.to_list packets))

(* The work of a console: it reads the messages that some part of it listens to, by the header. *)
let reads =
  Message.
    [
      Announce.id; Heartbeat.id; Estimated_state.id; Vehicle_state.id; Plan_control.id;
      Plan_control_state.id; Entity_list.id; Text_message.id; Fuel_level.id;
    ]

let receive s =
  match Header.read s with
  | Ok h when List.mem h.id reads -> Result.is_ok (Packet.decode_after h s)
  | Ok _ | Error _ -> false

let () =
  let flood = packets Sys.argv.(1) and lifecycle = packets Sys.argv.(2) in
  let decode s = Packet.decode s in
  let decoded packets = Array.map (fun p -> get (decode p)) packets in
  Printf.printf "Flood: one vehicle's telemetry, about 700 datagrams a second.\n";
  measure "skip by header" flood (fun s -> Header.read s);
  measure "header and checksum" flood (fun s -> Header.check (get (Header.read s)) s);
  measure "receive: read what is wanted, skip the rest" flood receive;
  measure "decode everything" flood decode;
  Printf.printf "Messages that are read.\n";
  let each name id = measure name (only [ id ] lifecycle) decode in
  each "Heartbeat" Message.Heartbeat.id;
  each "Announce" Message.Announce.id;
  each "EstimatedState" Message.Estimated_state.id;
  each "VehicleState" Message.Vehicle_state.id;
  each "PlanControlState" Message.Plan_control_state.id;
  each "PlanControl" Message.Plan_control.id;
  let small = only reads lifecycle in
  measure "all of them" small decode;
  let sent = decoded small in
  let encode i = Packet.encode sent.(i) in
  let indices = Array.init (Array.length sent) Fun.id in
  let start = Unix.gettimeofday () in
  for _ = 1 to 200 do
    Array.iter (fun i -> ignore (Sys.opaque_identity (encode i))) indices
  done;
  let rate = float (200 * Array.length sent) /. (Unix.gettimeofday () -. start) in
  Printf.printf "%-42s %6.2f M/s  %6.0f ns\n" "encode all of them" (rate /. 1e6) (1e9 /. rate)
