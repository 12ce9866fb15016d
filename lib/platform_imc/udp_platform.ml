open Dolphin_semantics
open Dolphin_runtime
open Lwt.Infix

type options = {
  id : int option;
  name : string option;
  program : string;
  loopback : bool;
  interfaces : Unix.inet_addr list;
  data_port : int;
  announce_ports : int list;
  group : Unix.inet_addr;
  payload : (Core.vehicle * string list) list;
  types : (Core.vehicle * string) list;
  type_names : (int * string) list;
  records : bool;
  abort : bool;
  run : string;
  close_patience : float;
  note : Core.vehicle -> string -> unit;
  keep : time:float -> Core.vehicle -> Yojson.Safe.t -> unit;
  sync : (unit -> unit Lwt.t) option;
  clock : Clock.t;
}

let default =
  { id = None; name = None; program = ""; loopback = false; interfaces = []; data_port = 0;
    announce_ports = [ 30100; 30101; 30102; 30103; 30104 ];
    group = Unix.inet_addr_of_string "224.0.75.69";
    payload = []; types = []; type_names = []; records = false; abort = false; run = ""; close_patience = 5.;
    note = (fun _ _ -> ());
    keep = (fun ~time:_ _ _ -> ()); sync = None; clock = Clock.system }

type t = {
  options : options;
  settings : Station.settings;
  now : unit -> float;
  data : Lwt_unix.file_descr;
  announcements : Lwt_unix.file_descr;
  speakers : Unix.file_descr list;  (* one for each interface that announcements leave by *)
  port : int;
  buffer : Bytes.t;
  mutable station : Station.t;
  mutable write_ahead : (Service.address * string) Write_ahead.t option;  (* if requests wait for the disk *)
  shell : Shell.t;
  mutable unsent : int;
}

exception Superseded of string

let name = "imc"
let virtual_time = false

(* Announcements come when they come. *)
let order = Dolphin_semantics.World.By_id

(* Vehicles announce every 10 s, and speak to a console up to 5 s after it has introduced itself: docs/rationale.md. *)
let longest_silence = 16.
let announce_period _ = longest_silence
let gathering = 0.002
let now p = p.now ()

(* {1 Sending} *)

let send p socket bytes host port =
  match Unix.sendto_substring socket bytes 0 (String.length bytes) [] (ADDR_INET (host, port)) with
  | _ -> Network_log.sent ~now:(now p) host port bytes
  | exception Unix.Unix_error (error, _, _) ->
    Network_log.unsent ~now:(now p) host port error;
    p.unsent <- p.unsent + 1

let data_socket p = Lwt_unix.unix_file_descr p.data
let broadcast = Unix.inet_addr_of_string "255.255.255.255"

let announce p bytes =
  let to_ports socket host = List.iter (send p socket bytes host) p.options.announce_ports in
  to_ports (data_socket p) Unix.inet_addr_loopback;
  List.iter
    (fun socket ->
       to_ports socket p.options.group;
       to_ports socket broadcast)
    p.speakers

let send_to p ((address : Service.address), bytes) =
  if not (Shell.is_closed p.shell) then send p (data_socket p) bytes address.host address.port

let carry_out p : Station.output -> unit = function
  | Send { address; bytes } -> (
      match p.write_ahead with
      | Some w when Write_ahead.is_waiting w -> Write_ahead.enqueue w (address, bytes)
      | Some _ | None -> send_to p (address, bytes))
  | Announce bytes -> announce p bytes
  | Announce_to (host, bytes) -> List.iter (send p (data_socket p) bytes host) p.options.announce_ports
  | Keep (vehicle, note) -> (
      p.options.keep ~time:(now p) vehicle (Durable_note.to_json note);
      match p.write_ahead with
      | Some w when Durable_note.is_write_ahead note ->
        p.station <- Station.leaves ~now:(now p) ~at:infinity [ vehicle ] p.station;
        Write_ahead.require w vehicle
      | Some _ | None -> ())
  | Remark (vehicle, text) -> p.options.note vehicle text

(* {1 The state and its changes} *)

let lives_in console what =
  Printf.sprintf "this run lives in %s: its journal was copied, or moved while it ran; %s" console what

let give_way p console =
  Shell.fail p.shell (Superseded (lives_in console "this console commands nothing any more"))

let change p (station, outputs) =
  Network_log.changed ~now:(now p) p.station station;
  p.station <- station;
  Option.iter (give_way p) (Station.twin station);
  List.iter (carry_out p) outputs

(* After some changes: code that waits for their results goes on. *)
let settle p =
  Shell.settle p.shell
    ~has_event:(Station.waiting p.station)
    ~quiet:(fun () -> Station.quiet ~now:(now p) p.station)
    ~due:(Station.due p.station)

let command p f =
  change p (f p.station);
  settle p

let quietly p f = command p (fun s -> (f s, []))

(* {1 Receiving} *)

(* The number of datagrams that are taken before others have their turn. *)
let most_at_once = 512

let write_ahead p sync =
  let settled vehicles =
    let time = now p in
    p.station <- Station.leaves ~now:time ~at:time vehicles p.station
  in
  let leave vehicles messages =
    let station, may_leave = Station.commands ~now:(now p) p.station in
    p.station <- station;
    if may_leave then List.iter (send_to p) messages;
    settled vehicles
  in
  let failed vehicles error = settled vehicles; Shell.fail p.shell error in
  Write_ahead.make ~sync ~leave ~failed

let absorb p changed = try change p changed with error -> Shell.fail p.shell error

(* How many were there. *)
let drain p fd =
  let socket = Lwt_unix.unix_file_descr fd in
  let rec take n =
    if n = most_at_once then n
    else
      match Unix.recvfrom socket p.buffer 0 (Bytes.length p.buffer) [] with
      | len, ADDR_INET (from, _) ->
        let now = now p in
        Network_log.received ~now ~from ~len p.buffer;
        (* Nothing is kept of the buffer. *)
        absorb p (Station.datagram ~now ~from ~len (Bytes.unsafe_to_string p.buffer) p.station);
        take (n + 1)
      | _, ADDR_UNIX _ -> take (n + 1)
      | exception Unix.Unix_error ((EAGAIN | EWOULDBLOCK), _, _) -> n
      | exception Unix.Unix_error ((EINTR | ECONNREFUSED | EHOSTUNREACH | ENETUNREACH), _, _) -> take (n + 1)
  in
  let n = take 0 in
  if n > 0 then settle p;
  n

(* More datagrams than this in a second, counted over a tenth of it, are a flood. *)
let flood = 1000.

let rec receive p fd ~since ~count =
  Lwt_unix.wait_read fd >>= fun () ->
  if Shell.is_closed p.shell then Lwt.return_unit
  else
    let count = count + drain p fd and time = now p in
    let elapsed = time -. since in
    let flooded = float_of_int count > flood *. Float.max 0.1 elapsed in
    let since, count = if elapsed > 0.1 then (time, 0) else (since, count) in
    let pause = if flooded then Lwt_unix.sleep gathering else Lwt.pause () in
    pause >>= fun () -> receive p fd ~since ~count

(* {1 Time} *)

let watch p =
  let tick ~now =
    absorb p (Station.tick ~now p.station);
    settle p
  in
  Shell.watch p.shell ~now:(fun () -> now p) ~due:(fun () -> Station.due p.station) ~tick

(* {1 Opening} *)

(* Within [close_patience]. *)
let abort_after = 3.

let settings options ~port ~hosts ~time : Station.settings =
  let random = Random.State.make_self_init () in
  let id = match options.id with Some id -> id | None -> 0x4000 + Random.State.int random 0x2000 in
  { id;
    name = Option.value options.name ~default:(Printf.sprintf "ccu-dolphin-%04x" id);
    program = options.program;
    addresses = List.map (fun host -> { Service.host; port }) hosts;
    epoch = options.clock.date () -. time;
    first_request = Random.State.int random 0x10000;
    payload = options.payload; types = options.types; type_names = options.type_names; records = options.records;
    run = options.run; jitter = Random.State.float random 1.;
    abort_after = (if options.abort then Some abort_after else None) }

let guard p thread = Lwt.async (fun () -> Lwt.catch thread (fun error -> Shell.fail p.shell error; Lwt.return_unit))

let make ?(time = 0.) ?past options =
  let loopback = Unix.inet_addr_loopback in
  let host = if options.loopback then loopback else Unix.inet_addr_any in
  List.iter Sockets.check_own options.interfaces;
  let announcements, data =
    Sockets.listen ~host ~announce_ports:options.announce_ports ~data_port:options.data_port
  in
  let hosts =
    if options.loopback then [ loopback ]
    else if options.interfaces <> [] then options.interfaces
    else Interfaces.local ()
  in
  let interfaces = if options.loopback then [] else List.filter (fun h -> h <> loopback) hosts in
  let port = Sockets.port_of data in
  let settings = settings options ~port ~hosts ~time in
  let station = Station.create settings in
  let resume (lingering, outstanding) = Station.resume ~now:time ~lingering outstanding station in
  let station = Option.fold past ~none:station ~some:resume in
  let announcements = Lwt_unix.of_unix_file_descr ~blocking:false announcements in
  Sockets.join announcements options.group ~interfaces;
  let p =
    { options; settings; now = Clock.stopwatch ~at:time options.clock;
      data = Lwt_unix.of_unix_file_descr ~blocking:false data;
      announcements; speakers = List.filter_map Sockets.speaker interfaces; port;
      buffer = Bytes.create 65536; station; write_ahead = None; shell = Shell.make (); unsent = 0 }
  in
  p.write_ahead <- Option.map (write_ahead p) options.sync;
  guard p (fun () -> receive p p.data ~since:0. ~count:0);
  guard p (fun () -> receive p p.announcements ~since:0. ~count:0);
  guard p (fun () -> watch p);
  p

let opened make =
  match make () with
  | p -> Ok p
  | exception Sockets.Cannot why -> Error why
  | exception Unix.Unix_error (error, call, _) ->
    Error (Printf.sprintf "the network cannot be used: %s: %s" call (Unix.error_message error))

let open_ options = opened (fun () -> make options)

let release_sockets p =
  Shell.close p.shell;
  List.iter Sockets.close_quietly p.speakers;
  Lwt.catch (fun () -> Lwt_unix.close p.data) (fun _ -> Lwt.return_unit) >>= fun () ->
  Lwt.catch (fun () -> Lwt_unix.close p.announcements) (fun _ -> Lwt.return_unit)

(* Claims are listened for before anything is commanded. *)
let rec alone p =
  match Station.twin p.station with
  | Some console ->
    release_sockets p >|= fun () -> Error (lives_in console "nothing was commanded")
  | None when Station.resuming p.station -> Lwt_unix.sleep 0.05 >>= fun () -> alone p
  | None -> Lwt.return (Ok p)

(* The notes that were kept, in order. *)
let notes_of history =
  let note { History.what; time = _ } =
    match what with
    | Noted (v, json) -> Option.map (fun note -> (v, note)) (Durable_note.of_json json)
    | Saw _ | Happened _ | Asked _ -> None
  in
  List.filter_map note history

let open_again options ~time history =
  let outstanding = History.outstanding ~announce_period:longest_silence history in
  let past = (Durable_note.lingering (notes_of history), outstanding) in
  match opened (fun () -> make ~time ~past options) with
  | Ok p -> Lwt.catch (fun () -> alone p) (fun error -> release_sockets p >>= fun () -> Lwt.fail error)
  | Error _ as error -> Lwt.return error

(* {1 Commands} *)

let set_timer p timer seconds =
  Network_log.timer_set ~now:(now p) timer seconds;
  quietly p (Station.set_timer ~now:(now p) timer seconds)

let cancel_timer p timer =
  Network_log.timer_cancelled ~now:(now p) timer;
  quietly p (Station.cancel_timer timer)

let bind p vehicles = command p (Station.bind ~now:(now p) vehicles)
let release p vehicles = command p (Station.release ~now:(now p) vehicles)
let start p ~number:_ vehicle task = command p (Station.start ~now:(now p) vehicle task)
let stop p vehicle = command p (Station.stop ~now:(now p) vehicle)
let set_connection_timeout p vehicles seconds = quietly p (Station.set_connection_timeout vehicles seconds)
let telemetry p how = quietly p (Station.telemetry ~now:(now p) (how <> Platform.Off))
let look _ = []

(* {1 Events} *)

let next p =
  Shell.next p.shell (fun () ->
      match Station.take p.station with
      | None -> None
      | Some (event, station) ->
        p.station <- station;
        Network_log.event ~now:(now p) event;
        Some event)

(* {1 Closing} *)

(* A stop that is confirmed later than this is worth a message to a waiting person; Execution.patience is usual. *)
let prompt = 2.

let tell_unsettled p text =
  let tell (v, plan) = p.options.note v (text plan) in
  List.iter tell (Station.unsettled ~now:(now p) p.station)

(* All is quiet, or has not become so in time. *)
let wait_for_stops p =
  if Station.quiet ~now:(now p) p.station then Lwt.return_unit
  else begin
    let quiet = Shell.until_quiet p.shell in
    let patience = p.options.close_patience in
    let patience = if Station.owes_stop p.station then Float.max patience longest_silence else patience in
    let tell () =
      let never, _ = Lwt.task () in
      tell_unsettled p (fun plan ->
          Printf.sprintf "has not confirmed yet that it stopped plan %s; waiting %.0f s more" plan
            (patience -. prompt));
      never
    in
    Lwt.pick [ quiet; Lwt_unix.sleep patience; (Lwt_unix.sleep prompt >>= tell) ]
  end

let close p =
  if Shell.is_closed p.shell then Lwt.return_unit
  else begin
    command p (Station.stop_all ~now:(now p));
    wait_for_stops p >>= fun () ->
    command p (fun s -> (s, Station.claims ~now:(now p) s));
    tell_unsettled p (Printf.sprintf "may still run plan %s: it was not heard to have stopped");
    release_sockets p
  end

let leave = release_sockets

(* {1 Displays} *)

let id p = p.settings.id
let name_on_network p = p.settings.name
let data_port p = p.port
let systems p = Station.systems ~now:(now p) p.station
let received p id = Station.received id p.station
let progress p vehicle = Station.plan vehicle p.station

type traffic = { accepted : int; skipped : int; dropped : (string * int) list; unsent : int }

let traffic p =
  { accepted = Station.accepted p.station; skipped = Station.skipped p.station; dropped = Station.dropped p.station;
    unsent = p.unsent }
