open Dolphin_platform_imc
open Dolphin_semantics
open Lwt.Infix

(* {1 One system} *)

let address (n : Node.t) =
  match n.address with Some a -> Format.asprintf "%a" Service.pp_address a | None -> "-"

let plan_of network (s : Station.system) =
  match Udp_platform.progress network s.state.id with
  | Some { plan; _ } -> Some plan
  | None -> Execution.executing s.node.execution

let mode definition n = Node.mode ~names:(Option.fold definition ~none:[] ~some:Compatibility.modes) n

(* Its messages, if there is a definition to read them by: the last of each kind, and their number. *)
let messages network (n : Node.t) definition =
  let shown (id, (e : Received.entry)) : Yojson.Safe.t =
    let last =
      match Dolphin_imc.Dynamic.decode definition e.order ~id e.payload with
      | Ok message -> Dolphin_imc.Dynamic.to_json message
      | Error why -> `String (Format.asprintf "%a" Dolphin_imc.Error.pp_decode why)
    in
    `Assoc [ ("id", `Int id); ("count", `Int e.count); ("last", last) ]
  in
  List.map shown (Udp_platform.received network n.id)

let is_placed (s : Station.system) = s.node.position <> None || s.node.announced_position <> None

let json network definition (s : Station.system) : Yojson.Safe.t =
  let n = s.node and state = s.state in
  let optional make = function Some x -> make x | None -> `Null in
  let number x = if Float.is_finite x then `Float x else `Null in
  let said = Option.fold definition ~none:[] ~some:(fun d -> [ ("messages", `List (messages network n d)) ]) in
  `Assoc
    ([ ("id", `String state.id); ("imc_id", `Int n.id); ("type", `String state.kind);
       ("address", optional (fun a -> `String (Format.asprintf "%a" Service.pp_address a)) n.address);
       ("latitude", if is_placed s then number state.position.latitude else `Null);
       ("longitude", if is_placed s then number state.position.longitude else `Null);
       ("height", if is_placed s then number state.position.height else `Null);
       ("mode", if n.mode = None then `Null else `String (mode definition n));
       ("error", if n.error = "" then `Null else `String n.error);
       ("battery", optional (fun (_, share) -> number share) n.battery);
       ("payload", `List (List.map (fun d -> `String d) state.payload));
       ("plan", optional (fun p -> `String p) (plan_of network s));
       ("linked", `Bool s.linked); ("available", `Bool (World.is_ready state));
       ("unready", optional (fun why -> `String why) state.unready); ("age", number s.age) ]
     @ said)

(* Entity lists name every task on board: only short ones fit a table. *)
let payload devices =
  match List.length devices with
  | 0 -> "-"
  | n when n <= 4 -> String.concat ", " devices
  | n -> Printf.sprintf "%d entities" n

let row network definition (s : Station.system) =
  let n = s.node and state = s.state in
  [ state.id; state.kind; Printf.sprintf "%04x" n.id; address n;
    (if is_placed s then Printf.sprintf "%.5f, %.5f" state.position.latitude state.position.longitude else "-");
    mode definition n;
    (match n.battery with Some (_, share) -> Printf.sprintf "%.0f%%" (100. *. share) | None -> "-");
    payload state.payload;
    Option.value (plan_of network s) ~default:"-";
    (if s.linked then Printf.sprintf "%.1f s" s.age else Printf.sprintf "no link, %.0f s" s.age);
    (if state.connected then Option.value state.unready ~default:"yes" else "-") ]

let heads = [ "VEHICLE"; "TYPE"; "IMC"; "ADDRESS"; "POSITION"; "MODE"; "BATTERY"; "PAYLOAD"; "PLAN"; "HEARD"; "READY" ]

let lines network definition ~json:as_json =
  match Udp_platform.systems network with
  | sights when as_json -> [ Dolphin_json.Canonical.to_string (`List (List.map (json network definition) sights)) ]
  | [] -> [ "no system was heard of" ]
  | sights -> Dolphin_display.Text_table.lines heads (List.map (row network definition) sights)

let listing network definition =
  { Listing.head = (fun () -> Printf.sprintf "%s hears, Ctrl-C ends" (Udp_platform.name_on_network network));
    lines = lines network definition;
    patience = Udp_platform.announce_period network }

let run options definition interruption ~as_json ~once ~seconds =
  match Udp_platform.open_ { options with Udp_platform.records = definition <> None && as_json } with
  | Error why -> Error (Error.Unavailable why)
  | Ok network ->
    Lwt_main.run
      (Listing.show (listing network definition) interruption ~as_json ~once ~seconds >>= fun () ->
       Udp_platform.close network);
    Ok ()
