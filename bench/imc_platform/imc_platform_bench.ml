open Dolphin_semantics
open Dolphin_runtime
open Dolphin_platform_imc
open Lwt.Infix
module Scenario = Dolphin_scenario.Scenario
module Network = Dolphin_sim_imc.Network

let first_port = 36000 + (Unix.getpid () mod 100 * 20)
let discovery = (first_port, first_port + 4)
let discovery_ports = List.init 5 (fun i -> first_port + i)

let scenario n : Scenario.t =
  let vehicle i : Scenario.vehicle =
    { id = Printf.sprintf "v%02d" i; kind = "UUV"; payload = []; position = Dolphin_geo.Place.apdl; speed = 1.5;
      battery = 1.; tells_battery = true; drain = 0.; charge = 0.; chargers = []; joins = 0.; leaves = None; drops = [];
      batteries = []; shows = []; places = [] }
  in
  let plan name least most : Scenario.plan =
    { name; duration = Some { least; most }; ending = Succeeds; place = None; only = []; charges = None }
  in
  { vehicles = List.init n vehicle; plans = [ plan "short" 0.5 1.5; plan "long" 600. 600. ]; answers = [];
    replies = []; inputs = []; samples = []; fences = []; plans_at = None; recurrences = [];
    begins = None; zone = None }

(* {1 The vehicles' process} *)

(* [with_vehicles n f] is [f ()] while [n] vehicles run in another process, and the lines that it logged. *)
let with_vehicles ?(flood = 0.) n f =
  let log = Filename.temp_file "dolphin" ".log" in
  flush stdout;
  match Lwt_unix.fork () with
  | 0 ->
    let channel = open_out log in
    let write json =
      output_string channel (Yojson.Safe.to_string json ^ "\n");
      flush channel
    in
    let settings =
      { (Network.default (scenario n)) with
        announce_period = 1.; contact_period = 0.2; first_port = first_port + 1000; discovery_ports = discovery; flood }
    in
    (match Network.create settings with
     | Ok network -> Lwt_main.run (Network.run ~log:write ~until:(fst (Lwt.wait ())) network)
     | Error why -> prerr_endline why);
    Unix._exit 0
  | child ->
    let finish () =
      Unix.kill child Sys.sigkill;
      ignore (Unix.waitpid [] child)
    in
    Fun.protect ~finally:finish f;
    let channel = open_in log in
    let rec read lines =
      match input_line channel with
      | line -> read (Yojson.Safe.from_string line :: lines)
      | exception (End_of_file | Yojson.Json_error _) -> close_in channel; List.rev lines
    in
    let lines = read [] in
    Sys.remove log;
    lines

(* {1 The console} *)

let compile source =
  match Dolphin_syntax.Parse.program ~file:"bench.dol" source with
  | Error _ -> failwith "the program does not parse"
  | Ok ast -> (
      match Elaborate.program ast ~source_name:"bench.dol" with
      | Ok (program, _) -> program
      | Error _ -> failwith "the program is wrong")

let options =
  let note v text = Printf.printf "  note: %s: %s\n" v text in
  { Udp_platform.default with loopback = true; announce_ports = discovery_ports; note }

let open_exn () = match Udp_platform.open_ options with Ok p -> p | Error why -> failwith why
let console = { Console.say = ignore; ask = (fun _ -> Lwt.return (Error "nobody")); refused = ignore }

let drive ?(observer = Observer.nobody) ?(interruption = fst (Lwt.wait ())) platform source =
  Driver.run (module Udp_platform) platform ~observer ~console ~interruption (compile source) >|= fun outcome ->
  match outcome with
  | Ended (Completed | Interrupted) -> ()
  | other -> Format.printf "  the program: %a@." Driver.pp_outcome other

(* {1 Figures} *)

let share_of xs share =
  let xs = List.sort compare xs in
  List.nth xs (int_of_float (share *. float_of_int (List.length xs - 1)))

let milliseconds x = 1000. *. x

let resident () =
  let channel = open_in "/proc/self/status" in
  let rec find () =
    match input_line channel with
    | line when String.length line > 6 && String.sub line 0 6 = "VmRSS:" -> Scanf.sscanf line "VmRSS: %d" Fun.id
    | _ -> find ()
    | exception End_of_file -> 0
  in
  let kilobytes = find () in
  close_in channel;
  float_of_int kilobytes /. 1024.

(* Datagrams that the system dropped for want of room on the socket of [port]. *)
let kernel_drops port =
  let channel = open_in "/proc/net/udp" in
  let wanted = Printf.sprintf ":%04X" port in
  let rec find () =
    match input_line channel with
    | exception End_of_file -> 0
    | line -> (
        match List.filter (fun s -> s <> "") (String.split_on_char ' ' line) with
        | _ :: local :: rest when String.length local > 8 && String.sub local 8 (String.length local - 8) = wanted ->
          int_of_string (List.nth rest (List.length rest - 1))
        | _ -> find ())
  in
  let drops = find () in
  close_in channel;
  drops

let processor () =
  let t = Unix.times () in
  t.tms_utime +. t.tms_stime

let latency () =
  let plan = "task('short')" in
  let chain = String.concat " >> " (List.init 10 (fun _ -> plan)) in
  let source =
    Printf.sprintf
      "v = pick { count 20; timeout 30.seconds }\nt = %s\nall = t\nfor (i in 2..20) { all = all | t }\nexecute all\n"
      chain
  in
  let connected = ref 0. and started = ref 0. in
  let transition ~time:_ ~cause:_ (t : Transition.t) =
    if !started = 0. && List.exists (function Effect.Start _ -> true | _ -> false) t.effects then
      started := Unix.gettimeofday ()
  in
  let news ~time:_ (s : World.vehicle_state) =
    if !started = 0. && s.connected then connected := Unix.gettimeofday ()
  in
  let lines =
    with_vehicles 20 (fun () ->
        Lwt_main.run (drive (open_exn ()) ~observer:{ Observer.nobody with transition; news } source))
  in
  let open Yojson.Safe.Util in
  let ended = Hashtbl.create 20 and gaps = ref [] and starts = ref 0 in
  List.iter
    (fun line ->
       let vehicle = to_string (member "vehicle" line) and time = to_number (member "time" line) in
       match to_string (member "did" line) with
       | "completed" -> Hashtbl.replace ended vehicle time
       | "started" ->
         incr starts;
         Option.iter (fun before -> gaps := (time -. before) :: !gaps) (Hashtbl.find_opt ended vehicle)
       | _ -> ())
    lines;
  Printf.printf "completion to next START, as the vehicles see it: median %.2f ms, 99%% %.2f ms, most %.2f ms (%d)\n"
    (milliseconds (share_of !gaps 0.5)) (milliseconds (share_of !gaps 0.99)) (milliseconds (share_of !gaps 1.))
    (List.length !gaps);
  Printf.printf "plans started: %d of 200\n" !starts;
  Printf.printf "last vehicle there to first START: %.1f ms\n%!" (milliseconds (!started -. !connected))

(* The cost of waiting for [n] vehicles that run long plans. *)
let waiting ?flood ~seconds n =
  let source =
    Printf.sprintf
      "v = pick { count %d; timeout 30.seconds }\nt = task('long')\nall = t\nfor (i in 2..%d) { all = all | t }\n\
       execute all\n"
      n n
  in
  let enough, stop = Lwt.wait () in
  let result = ref "" in
  let watch platform =
    Lwt_unix.sleep 8. >>= fun () ->
    let before = processor () and seen = Udp_platform.traffic platform in
    let port = Udp_platform.data_port platform in
    let lost = kernel_drops port in
    Lwt_unix.sleep seconds >|= fun () ->
    let used = (processor () -. before) /. seconds and now = Udp_platform.traffic platform in
    let rate = float_of_int (now.accepted + now.skipped - seen.accepted - seen.skipped) /. seconds in
    result :=
      Printf.sprintf "%.2f%% of a core, %.0f datagrams/s, %d lost by the socket, %.0f MB" (100. *. used) rate
        (kernel_drops port - lost) (resident ());
    Lwt.wakeup stop ()
  in
  let run () =
    let platform = open_exn () in
    Lwt.async (fun () -> watch platform);
    drive ~interruption:enough platform source
  in
  ignore (with_vehicles ?flood n (fun () -> Lwt_main.run (run ())));
  Printf.printf "waiting on %d vehicles%s: %s\n%!" n (if flood = None then "" else " that flood") !result

let () =
  latency ();
  waiting ~seconds:15. 4;
  waiting ~seconds:15. 20;
  waiting ~flood:700. ~seconds:15. 20
