open Dolphin_scenario
open Dolphin_runtime
open Lwt.Infix

type settings = {
  scenario : Scenario.t;
  seed : int;
  speed : float;
  faults : Link_faults.t;
  strict : bool;
  refuses : (string * string) list;
  blocks : (string * (float * float)) list;
  stalls : (string * (float * float)) list;
  vanishes : (string * (float * float)) list;
  announce_period : float;
  contact_period : float;
  first_id : int;
  first_port : int;
  discovery_ports : int * int;
  address : string option;
  flood : float;
}

let default scenario =
  { scenario; seed = 0; speed = 1.; faults = Link_faults.none; strict = false; refuses = []; blocks = []; stalls = [];
    vanishes = [];
    announce_period = 10.; contact_period = 5.; first_id = 0x3001; first_port = 6002;
    discovery_ports = 30100, 30104; address = None; flood = 0. }

(* A socket that never blocks, seen by Lwt and without it. *)
type socket = { port : int; unix : Unix.file_descr; lwt : Lwt_unix.file_descr }
type craft = {
  vehicle : Scenario.vehicle;
  id : int;
  socket : socket;
  mutable radio : Radio.t option;
  mutable told : int;
}

type t = {
  settings : settings;
  clock : Clock.t;
  discovery : socket;
  crafts : craft list;
  buffer : Bytes.t;
  mutable now : unit -> float;                  (* time starts in [run] *)
  mutable changed : unit Lwt.u option;          (* to wake those waiting for a change of the queue *)
}

type vehicle = { name : string; kind : string; id : int; port : int }

let vehicles n =
  List.map (fun (c : craft) -> { name = c.vehicle.id; kind = c.vehicle.kind; id = c.id; port = c.socket.port }) n.crafts

(* {1 Sockets} *)

let loopback = "127.0.0.1"
let group = Unix.inet_addr_of_string "224.0.75.69"
let everyone = Unix.inet_addr_of_string "255.255.255.255"

let open_socket host port =
  let unix = Unix.socket ~cloexec:true PF_INET SOCK_DGRAM 0 in
  match Unix.bind unix (ADDR_INET (host, port)) with
  | () ->
    Unix.set_nonblock unix;
    Some { port; unix; lwt = Lwt_unix.of_unix_file_descr ~blocking:false ~set_flags:false unix }
  | exception Unix.Unix_error (_, _, _) ->
    Unix.close unix;
    None

let rec first_free host port last =
  if port > last then None
  else match open_socket host port with Some socket -> Some socket | None -> first_free host (port + 1) last

let close_socket socket = try Unix.close socket.unix with Unix.Unix_error (_, _, _) -> ()

let close n =
  close_socket n.discovery;
  List.iter (fun c -> close_socket c.socket) n.crafts

(* Without a network, joining a group and hearing others is impossible. *)
let join_group socket =
  try
    Lwt_unix.mcast_add_membership socket.lwt group;
    Lwt_unix.mcast_set_loop socket.lwt false;
    Unix.setsockopt socket.unix SO_BROADCAST true
  with Unix.Unix_error (_, _, _) -> ()

let send socket bytes host port =
  (* As on any network, a datagram that cannot be sent is lost. *)
  try ignore (Unix.sendto_substring socket.unix bytes 0 (String.length bytes) [] (ADDR_INET (host, port)))
  with Unix.Unix_error (_, _, _) -> ()

(* {1 The beginning} *)

let rec open_all host port = function
  | [] -> Ok []
  | (id, vehicle) :: rest -> (
      match first_free host port (port + 1000) with
      | None -> Error (Printf.sprintf "there is no free UDP port from %d to %d" port (port + 1000))
      | Some socket -> (
          match open_all host (socket.port + 1) rest with
          | Ok crafts -> Ok ({ vehicle; id; socket; radio = None; told = 0 } :: crafts)
          | Error _ as error -> close_socket socket; error))

(* Beyond are the numbers that stand for no system of its own. *)
let last_id = 0xFFEF

let create ?(clock = Clock.system) s =
  let first, last = s.discovery_ports in
  let numbered = List.mapi (fun i v -> s.first_id + i, v) s.scenario.vehicles in
  let host = if s.address = None then Unix.inet_addr_loopback else Unix.inet_addr_any in
  if s.first_id + List.length numbered - 1 > last_id then
    Error (Printf.sprintf "there are more vehicles than numbers of IMC systems from %d to %d" s.first_id last_id)
  else
    match first_free Unix.inet_addr_any first last with
    | None ->
      let what = "on which IMC systems find each other" in
      Error (Printf.sprintf "none of the UDP ports %d to %d, %s, is free" first last what)
    | Some discovery -> (
        join_group discovery;
        match open_all host s.first_port numbered with
        | Error _ as error -> close_socket discovery; error
        | Ok crafts ->
          Ok { settings = s; clock; discovery; crafts; buffer = Bytes.create 65536; now = (fun () -> 0.);
               changed = None })

let radio n ~epoch (c : craft) =
  let s = n.settings in
  let address host : Address.t = { host; port = c.socket.port } in
  let others = match s.address with Some host -> [ address host ] | None -> [] in
  let own (name, x) = if name = c.vehicle.id then Some x else None in
  let drops = List.map (fun (from, lasts) -> { Scenario.from; lasts }) (List.filter_map own (s.vanishes @ s.stalls)) in
  let vehicle = { c.vehicle with drops = c.vehicle.drops @ drops } in
  Radio.create ~faults:s.faults ~seed:s.seed
    { engine =
        { vehicle; plans = s.scenario.plans; samples = s.scenario.samples; seed = s.seed; epoch; strict = s.strict;
          refuses = List.assoc_opt c.vehicle.id s.refuses; blocks = List.filter_map own s.blocks;
          losses = List.map (fun (from, lasts) -> from +. lasts) (List.filter_map own s.stalls) };
      id = c.id; addresses = address loopback :: others; speed = s.speed; announce_period = s.announce_period;
      contact_period = s.contact_period }

(* {1 Life} *)

let now n = n.now ()

let send_discovery n bytes =
  let first, last = n.settings.discovery_ports in
  for port = first to last do
    if port <> n.discovery.port then send n.discovery bytes Unix.inet_addr_loopback port;
    if n.settings.address <> None then
      List.iter (fun host -> send n.discovery bytes host port) [ group; everyone ]
  done

let send_datagram n c (d : Radio.datagram) =
  match d.destination with
  | Discovery -> send_discovery n d.bytes
  | System { host; port } -> send c.socket d.bytes (Unix.inet_addr_of_string host) port

(* Whatever happens may change what is due. *)
let wake n =
  match n.changed with
  | None -> ()
  | Some waiting ->
    n.changed <- None;
    Lwt.wakeup_later waiting ()

let update n ~log ~at c step =
  match c.radio with
  | None -> ()
  | Some radio ->
    let datagrams, activities, radio = step radio in
    c.radio <- Some radio;
    List.iter (send_datagram n c) datagrams;
    List.iter (fun activity -> log (Activity.to_json ~time:at ~vehicle:c.vehicle.id activity)) activities

let due n =
  let earliest time c =
    match Option.bind c.radio Radio.due with Some time' -> Float.min time time' | None -> time
  in
  List.fold_left earliest infinity n.crafts

let advance n ~log =
  let at = now n in
  let advance_if_due c =
    match Option.bind c.radio Radio.due with
    | Some time when time <= at -> update n ~log ~at c (Radio.advance ~at)
    | Some _ | None -> ()
  in
  List.iter advance_if_due n.crafts

let rec live n ~log =
  advance n ~log;
  let wait = due n -. now n in
  if wait <= 0. then Lwt.pause () >>= fun () -> live n ~log
  else
    let changed, waker = Lwt.task () in
    n.changed <- Some waker;
    let time = if wait < 3600. then Lwt_unix.sleep wait else fst (Lwt.task ()) in
    Lwt.pick [ changed; time ] >>= fun () -> live n ~log

(* [take bytes host] for each datagram that has come to [socket]; at most as many as leave others their turn. *)
let rec drain n socket take left =
  if left > 0 then
    match Unix.recvfrom socket.unix n.buffer 0 (Bytes.length n.buffer) [] with
    | length, ADDR_INET (host, _) ->
      take (Bytes.sub_string n.buffer 0 length) (Unix.string_of_inet_addr host);
      drain n socket take (left - 1)
    | _, ADDR_UNIX _ -> drain n socket take (left - 1)
    | exception Unix.Unix_error ((EAGAIN | EWOULDBLOCK), _, _) -> ()
    | exception Unix.Unix_error (_, _, _) -> drain n socket take (left - 1)

let rec listen n socket take =
  Lwt_unix.wait_read socket.lwt >>= fun () ->
  drain n socket take 64;
  wake n;
  Lwt.pause () >>= fun () -> listen n socket take

let receive n ~log channel c bytes host =
  let at = now n in
  update n ~log ~at c (Radio.receive ~at channel ~host bytes)

(* {1 Flood} *)

let flood_period = 0.01

(* Delays of more than a few periods are not made up for. *)
let most_at_once rate = 1 + int_of_float (rate *. 5. *. flood_period)

let is_heard ~at c =
  match c.radio with Some r -> Vehicle_node.listeners ~at (Radio.node r) <> [] | None -> false

let flood_one n ~log ~at ~number c =
  for i = 0 to number - 1 do
    let src_ent, content = Flood.content (c.told + i) in
    update n ~log ~at c (Radio.tell ~at ~src_ent ~content)
  done;
  c.told <- c.told + number

let rec flood n ~log ~since =
  let rate = n.settings.flood in
  Lwt_unix.sleep flood_period >>= fun () ->
  let at = now n in
  let number = int_of_float (rate *. (at -. since)) in
  List.iter (fun c -> if is_heard ~at c then flood_one n ~log ~at ~number:(min number (most_at_once rate)) c) n.crafts;
  flood n ~log ~since:(since +. (float_of_int number /. rate))

let run ~log ~until n =
  n.now <- Clock.stopwatch n.clock;
  let epoch = n.clock.date () in
  List.iter (fun c -> c.radio <- Some (radio n ~epoch c)) n.crafts;
  let to_all bytes host = List.iter (fun c -> receive n ~log Announcements c bytes host) n.crafts in
  let data c = listen n c.socket (receive n ~log Data c) in
  let further = if n.settings.flood > 0. then [ flood n ~log ~since:0. ] else [] in
  Lwt.pick ([ until; live n ~log; listen n n.discovery to_all ] @ List.map data n.crafts @ further)
