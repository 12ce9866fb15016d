open Dolphin_imc
open Lwt.Infix

type t = {
  id : int;
  name : string;
  announce_ports : int list;
  socket : Lwt_unix.file_descr;
  port : int;
  model : Vehicle_model.t;
  inbound : (Unix.sockaddr * string) Network.t;
  outbound : (Unix.sockaddr * string) Network.t;
  multiplier : float;
  date : unit -> float;
  buffer : Bytes.t;
  mutable peers : (int * Unix.sockaddr) list;
  mutable next_announce : float;
  mutable next_position : float;
  mutable copies : int;
  mutable ends : (float * string) list;
  mutable starts : (float * string) list;
  mutable stopped : bool;
}

let model v = v.model
let ends v = v.ends
let starts v = v.starts
let now = Dolphin_runtime.Clock.system.elapsed
let loopback port = Unix.ADDR_INET (Unix.inet_addr_loopback, port)

let encode v ?(dst = Header.nobody) message =
  Result.get_ok (Packet.encode (Packet.make ~src:v.id ~dst ~timestamp:(v.date ()) message))

let transmit v (address, bytes) =
  let fd = Lwt_unix.unix_file_descr v.socket in
  try ignore (Unix.sendto_substring fd bytes 0 (String.length bytes) [] address) with Unix.Unix_error _ -> ()

let post v address bytes =
  Network.send ~now:(now ()) (address, bytes) v.outbound;
  List.iter (transmit v) (Network.arrived ~now:(now ()) v.outbound)

let note_end v (message : Message.t) =
  match message with
  | Plan_control { type_ = Success; info = "plan completed"; plan_id; _ } -> v.ends <- (now (), plan_id) :: v.ends
  | _ -> ()

let say v messages =
  let one message =
    note_end v message;
    let reply_to = match (message : Message.t) with Plan_control _ -> List.map fst v.peers | _ -> [] in
    List.iter
      (fun (peer, address) ->
         let dst = if List.mem peer reply_to then peer else Header.nobody in
         post v address (encode v ~dst message))
      v.peers
  in
  List.iter one messages

let announce v =
  let services = Printf.sprintf "imc+udp://127.0.0.1:%d/;http://127.0.0.1:8080/dune" v.port in
  let bytes =
    encode v ~dst:0
      (Announce
         { Message.Announce.default with
           sys_name = v.name; sys_type = Uuv; lat = 0.7188; lon = -0.15195; services })
  in
  List.iter (fun port -> transmit v (loopback port, bytes)) v.announce_ports

let hear v (address, bytes) =
  match Packet.decode bytes with
  | Error _ -> ()
  | Ok p -> (
      if not (List.mem_assoc p.src v.peers) then v.peers <- (p.src, address) :: v.peers;
      match p.content with
      | Message (Plan_control r) when p.dst = v.id && r.type_ = Request ->
        v.copies <- v.copies + 1;
        if r.op = Start then v.starts <- (now (), r.plan_id) :: v.starts;
        say v (Vehicle_model.request ~now:(now ()) ~copy:v.copies r v.model)
      | Message (Entity_list { op = Query; _ }) ->
        say v [ Entity_list { op = Report; list = "Daemon=0;DVL=58;Sidescan=60" } ]
      | Message _ | Unknown _ -> ())

let receive v =
  let fd = Lwt_unix.unix_file_descr v.socket in
  match Unix.recvfrom fd v.buffer 0 (Bytes.length v.buffer) [] with
  | len, address -> Network.send ~now:(now ()) (address, Bytes.sub_string v.buffer 0 len) v.inbound; true
  | exception Unix.Unix_error _ -> false

let telemetry v =
  if now () < v.next_position || v.peers = [] then []
  else begin
    v.next_position <- now () +. (0.5 /. v.multiplier);
    [ Message.Heartbeat;
      Estimated_state { Message.Estimated_state.default with lat = 0.7188; lon = -0.15195; x = 10. };
      Fuel_level { Message.Fuel_level.default with value = 80.; confidence = 100. } ]
  end

let rec live v =
  if v.stopped then Lwt_unix.close v.socket
  else begin
    while receive v do () done;
    if now () >= v.next_announce then begin
      announce v;
      v.next_announce <- now () +. 10.
    end;
    List.iter (hear v) (Network.arrived ~now:(now ()) v.inbound);
    say v (Vehicle_model.tick ~now:(now ()) v.model @ telemetry v);
    List.iter (transmit v) (Network.arrived ~now:(now ()) v.outbound);
    Lwt.pick [ Lwt_unix.sleep 0.002; (Lwt_unix.wait_read v.socket >>= Lwt.pause) ] >>= fun () -> live v
  end

let perfect = { Network.loss = 0.; duplication = 0.; delay = 0. }

let start ?(quality = perfect) ?(seed = 0) ?(multiplier = 1.) ?(date = Unix.gettimeofday) ~announce_ports ~id ~name
    ~fate () =
  let fd = Unix.socket ~cloexec:true PF_INET SOCK_DGRAM 0 in
  Unix.bind fd (loopback 0);
  Unix.set_nonblock fd;
  let port = match Unix.getsockname fd with ADDR_INET (_, port) -> port | ADDR_UNIX _ -> 0 in
  let random = Random.State.make [| seed; id |] in
  let before = { Message.Plan_control_state.default with state = Ready; plan_progress = -1. } in
  let v =
    { id; name; announce_ports; socket = Lwt_unix.of_unix_file_descr ~blocking:false fd; port;
      model = Vehicle_model.create ~fate ~before;
      inbound = Network.create random quality; outbound = Network.create random quality; multiplier; date;
      buffer = Bytes.create 65536; peers = []; next_announce = 0.; next_position = 0.; copies = 0;
      ends = []; starts = []; stopped = false }
  in
  Lwt.async (fun () -> live v);
  v

let stop v =
  v.stopped <- true;
  Lwt_unix.sleep 0.05
