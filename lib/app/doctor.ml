type finding = { subject : string; found : string; advice : string option; is_needed : bool }

let well subject found = { subject; found; advice = None; is_needed = false }
let missing ?(is_needed = false) subject found advice = { subject; found; advice = Some advice; is_needed }

let clocks () =
  let before = Mtime_clock.elapsed_ns () in
  Unix.sleepf 0.01;
  let passed = Int64.to_float (Int64.sub (Mtime_clock.elapsed_ns ()) before) *. 1e-9 in
  let year = (Unix.gmtime (Unix.time ())).tm_year + 1900 in
  if passed < 0.009 || passed > 5. then
    missing ~is_needed:true "clock"
      (Printf.sprintf "10 ms take %g s" passed)
      "the steady clock of this machine is not right"
  else if year < 2024 then
    missing "clock" (Printf.sprintf "this is the year %d" year)
      "set the clock, or let it be set (NTP): names and headers of journals have the date"
  else well "clock" "steady, and set"

(* {1 The network} *)

let with_socket f =
  let socket = Unix.socket ~cloexec:true PF_INET SOCK_DGRAM 0 in
  Fun.protect ~finally:(fun () -> Unix.close socket) (fun () -> f socket)

let socket () =
  match with_socket (fun socket -> Unix.bind socket (ADDR_INET (Unix.inet_addr_any, 0))) with
  | () -> well "sockets" "UDP can be used"
  | exception Unix.Unix_error (error, _, _) ->
    missing "sockets" (Unix.error_message error)
      "vehicles of a network need UDP; simulated ones do not"

let discovery_ports = List.init 5 (fun i -> 30100 + i)

let free port =
  match with_socket (fun socket -> Unix.bind socket (ADDR_INET (Unix.inet_addr_any, port))) with
  | () -> true
  | exception Unix.Unix_error _ -> false

let ports () =
  match List.partition free discovery_ports with
  | _ :: _, [] -> well "announcements" "ports 30100 to 30104 are free"
  | (_ :: _ as unused), _ ->
    well "announcements"
      (Printf.sprintf "%d of the ports 30100 to 30104 are free, and one is enough" (List.length unused))
  | [], _ ->
    missing "announcements" "ports 30100 to 30104 are all taken"
      "vehicles are not heard: end other consoles, or name ports by --imc-discovery-ports"

let multicasts () =
  let here = List.filter (fun a -> a <> Unix.inet_addr_loopback) (Dolphin_platform_imc.Interfaces.local ()) in
  match here with
  | [] ->
    missing "network" "this machine has no address but its own loopback"
      "only vehicles on this machine are heard (--imc-loopback)"
  | _ :: _ -> well "network" (String.concat ", " (List.map Unix.string_of_inet_addr here))

(* {1 Files and programs} *)

let runs () =
  match Run_folder.writable () with
  | Ok folder -> well "runs" folder
  | Error e ->
    missing "runs" (Format.asprintf "%a" Error.pp e) "journals are not kept: let XDG_STATE_HOME name a folder of yours"

let tlc () =
  match Dolphin_tlc.Installation.find Sys.getenv_opt with
  | Ok { java; jar } -> well "TLC" (Printf.sprintf "%s, by %s" jar java)
  | Error (No_jar _) ->
    missing "TLC" "its archive, tla2tools.jar, was not found"
      "only dolphin tla --run needs it: --tlc names the archive, or 'make tlc' fetches it"
  | Error trouble ->
    missing "TLC" (Format.asprintf "@[<h>%a@]" Dolphin_tlc.Installation.pp_trouble trouble)
      "only dolphin tla --run wants it: explore checks programs without"

let console page () =
  let advice =
    "dolphin console serves only its programming interface: in the sources, scripts/console --build builds the page \
     (it needs npm), and scripts/install installs it; DOLPHIN_CONSOLE names the folder of a page that is elsewhere"
  in
  match page with
  | Some folder when Sys.file_exists (Filename.concat folder "index.html") ->
    well "console" ("its page is in " ^ folder)
  | Some folder -> missing "console" (Printf.sprintf "%s has no page: no index.html" folder) advice
  | None -> missing "console" "its page is not installed" advice

let examine ~page =
  List.map (fun look -> look ()) [ clocks; socket; ports; multicasts; runs; console page; tlc ]
