open Dolphin_imc
open Dolphin_sim_imc

type heard = { time : float; announced : bool; packet : Packet.t }

type t = {
  mutable node : Vehicle_node.t;
  mutable now : float;
  mutable heard : heard list;                   (* latest first *)
  mutable activities : Activity.t list;                  (* latest first *)
}

let console = 0x4ABC
let vehicle = 0x1A
let epoch = 1.7e9

let scenario source =
  match Dolphin_scenario.Scenario.read ~file:"test.fleet" source with
  | Ok s -> s
  | Error faults -> Alcotest.failf "%a" (Fmt.list (Dolphin_syntax.Diagnostic.pp ~source)) faults

let settings ?(speed = 1.) ?(contact_period = 0.) ?(strict = false) ?refuses ?(blocks = []) ?(losses = [])
    ?(seed = 0) source :
  Vehicle_node.settings =
  let { Dolphin_scenario.Scenario.vehicles; plans; _ } = scenario source in
  { engine = { vehicle = List.hd vehicles; plans; samples = []; seed; epoch; strict; refuses; blocks; losses };
    id = vehicle; addresses = [ { host = "127.0.0.1"; port = 6002 } ]; speed; announce_period = 10.; contact_period }

let make settings = { node = Vehicle_node.create settings; now = 0.; heard = []; activities = [] }
let now s = s.now
let node s = s.node

let take s (outputs, activities, node) =
  let hear { Vehicle_node.destination; packet } =
    { time = s.now; announced = (destination = Vehicle_node.Discovery); packet } in
  s.node <- node;
  s.heard <- List.rev_append (List.map hear outputs) s.heard;
  s.activities <- List.rev_append activities s.activities

let until s time =
  let rec go stuck =
    if stuck > 100 then Alcotest.failf "time does not go on at %.9f" s.now;
    match Vehicle_node.due s.node with
    | Some due when due <= time ->
      let stuck = if due > s.now then 0 else stuck + 1 in
      s.now <- Float.max s.now due;
      take s (Vehicle_node.advance ~at:s.now s.node);
      go stuck
    | Some _ | None -> s.now <- time
  in
  go 0

let receive s channel host packet =
  take s (Vehicle_node.receive ~at:s.now channel ~host packet s.node)

let packet s ?(id = console) ?(dst = vehicle) message =
  Packet.make ~src:id ~src_ent:1 ~dst ~timestamp:(epoch +. s.now) message

let announce ?(id = console) ?(port = 6001) s =
  let services = Printf.sprintf "imc+udp://127.0.0.1:%d/;imc+info://0.0.0.0/version/5.4.31" port in
  let message = { Message.Announce.default with sys_name = "ccu-test"; owner = 65535; services } in
  receive s Announcements "127.0.0.1" (packet s ~id ~dst:0 (Announce message))

let send ?id ?dst ?(host = "127.0.0.1") s message = receive s Data host (packet s ?id ?dst message)
let join s = announce s; send s Heartbeat

let rec beat_until s time =
  if now s +. 1. < time then begin
    until s (now s +. 1.);
    send s Heartbeat;
    beat_until s time
  end
  else until s time

let start ?dst ?arg ?(flags = Message.Plan_control.Flags.none) s number plan =
  send ?dst s
    (Plan_control
       { Message.Plan_control.default with
         type_ = Request; op = Start; request_id = number; plan_id = plan; flags; arg })

let stop s number =
  send s (Plan_control { Message.Plan_control.default with type_ = Request; op = Stop; request_id = number })

let heard s = List.rev s.heard
let forget s = s.heard <- []; s.activities <- []
let activities s = List.rev s.activities

let count s message =
  List.length (List.filter (fun h -> Packet.id h.packet = Message.id message) s.heard)

(* {1 Stories} *)

let kind text = String.sub text 0 (String.index text ' ')

let line (p : Packet.t) =
  match p.content with
  | Message (Plan_control_state s) ->
    Some
      (Printf.sprintf "state %s '%s' %s %s"
         (Message.Plan_control_state.State.name s.state)
         s.plan_id
         (if s.man_id = "" then "-" else s.man_id)
         (Message.Plan_control_state.Last_outcome.name s.last_outcome))
  | Message (Vehicle_state s) -> Some ("vehicle " ^ Message.Vehicle_state.Op_mode.name s.op_mode)
  | Message (Plan_control { type_ = Request; _ }) -> None
  | Message (Plan_control c) ->
    Some
      (Printf.sprintf "reply %s %s %d '%s' %s"
         (Message.Plan_control.Type.name c.type_) (Message.Plan_control.Op.name c.op) c.request_id c.plan_id c.info)
  | Message (Log_book_entry { context = ("Plan.Engine" | "Plan.DB" | "Supervisors.Vehicle") as context; text; type_; _ })
    -> Some (Printf.sprintf "log %s: %s: %s" context (Message.Log_book_entry.Type.name type_) text)
  | Message (Plan_db d) ->
    Some
      (Printf.sprintf "store %s %s %d '%s' %s" (Message.Plan_db.Type.name d.type_) (Message.Plan_db.Op.name d.op)
         d.request_id d.plan_id d.info)
  | Message _ | Unknown _ -> None

let is_repeated text = List.mem (kind text) [ "state"; "vehicle" ]

(* Without repeated states. *)
let summarise packets =
  let add (lines, last) p =
    match line p with
    | None -> lines, last
    | Some text when is_repeated text && List.assoc_opt (kind text) last = Some text -> lines, last
    | Some text -> text :: lines, (kind text, text) :: List.remove_assoc (kind text) last
  in
  List.rev (fst (List.fold_left add ([], []) packets))

let story s = summarise (List.map (fun h -> h.packet) (heard s))
let summary s = List.filter (fun line -> not (List.mem (kind line) [ "log"; "store" ])) (story s)
