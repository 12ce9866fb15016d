open Dolphin_imc
open Dolphin_platform_imc
open Dolphin_runtime
module State = Message.Plan_control_state

let loopback = Unix.inet_addr_loopback
let vehicle = 0x1A
let name = "lauv-1"

let settings id : Station.settings =
  { id; name = Printf.sprintf "ccu-%x" id; program = "p.dol"; addresses = [ { host = loopback; port = 6001 } ];
    epoch = 0.; first_request = id; payload = []; types = []; type_names = []; records = false; abort_after = None;
    run = "a"; jitter = 0. }

let instant = 0.01

(* A console, its journal, and the vehicle. *)
type world = {
  mutable now : float;
  mutable station : Station.t;
  mutable notes : (string * Durable_note.t) list;  (* latest first *)
  mutable failed : bool;
  mutable stops : int;
  mutable own : int;  (* the console's IMC address *)
  model : Vehicle_model.t;
}

let encode w message =
  Result.get_ok (Packet.encode (Packet.make ~src:vehicle ~dst:w.own ~timestamp:(1000. +. w.now) message))

let rec change w (station, outputs) =
  w.station <- station;
  List.iter (carry_out w) outputs

and carry_out w : Station.output -> unit = function
  | Keep (v, note) -> w.notes <- (v, Option.get (Durable_note.of_json (Durable_note.to_json note))) :: w.notes
  | Send { bytes; _ } -> (
      match Packet.decode bytes with
      | Ok { content = Message (Plan_control request); _ } ->
        if request.op = Stop then w.stops <- w.stops + 1;
        hear w (Vehicle_model.request ~now:w.now ~copy:1 request w.model)
      | Ok _ | Error _ -> ())
  | Announce _ | Announce_to _ | Remark _ -> ()

and hear w messages =
  let one message = change w (Station.datagram ~now:w.now ~from:loopback (encode w message) w.station) in
  List.iter one messages

let rec read w =
  match Station.take w.station with
  | None -> ()
  | Some (event, station) ->
    w.station <- station;
    (match event with
     | Task_failed _ -> w.failed <- true
     | Task_done _ | Vehicle _ | Timer _ | Input _ | Quiet -> ());
    read w

let announce =
  Message.Announce
    { Message.Announce.default with sys_name = name; sys_type = Uuv; services = "imc+udp://127.0.0.1:6002/" }

let here = Message.Estimated_state { Message.Estimated_state.default with lat = 0.7; lon = 0.1 }

let step w =
  w.now <- w.now +. instant;
  hear w (Vehicle_model.tick ~now:w.now w.model);
  if Float.rem w.now 0.5 < instant then hear w [ here ];
  if Station.due w.station <= w.now then change w (Station.tick ~now:w.now w.station);
  read w

let until w time = while w.now < time do step w done
let maneuvers w = Vehicle_model.maneuvers w.model

let is_free w =
  let free (x : Station.system) = x.node.name = name && x.state.connected && x.state.unready = None in
  List.exists free (Station.systems ~now:w.now w.station)

let task : Dolphin_semantics.Core.platform_task = { name = "p"; plan = None; task_site = 0 }

(* What the journal of the killed console says. *)
let outstanding w : History.outstanding =
  let notes = List.map (fun (_, note) -> Durable_note.to_json note) w.notes in
  let commanded : History.commanded =
    { task; number = 0; is_again = false; is_stopped = false; notes; before = None } in
  { bound = []; tasks = (if w.failed then [] else [ (name, commanded) ]); timers = []; timeout = None; timeouts = [] }

(* The plan is lost at 3 s, and its maneuver goes on for [lasts]; the console is killed at [killed], and another one
   resumes its run a moment later. *)
let life (lasts, killed, pause) =
  let before = { State.default with state = Ready; plan_id = "q" } in
  let model = Vehicle_model.create ~fate:(fun _ -> Is_lost (2., lasts)) ~before in
  let w = { now = 0.; station = Station.create (settings 0x4001); notes = []; failed = false; stops = 0;
            own = 0x4001; model } in
  hear w [ announce ];
  until w 1.;
  change w (Station.start ~now:w.now name task w.station);
  until w killed;
  let journal = outstanding w and notes = List.rev w.notes in
  let went_on = maneuvers w in
  while w.now < killed +. pause do
    w.now <- w.now +. instant;
    ignore (Vehicle_model.tick ~now:w.now w.model)
  done;
  let lingering = Durable_note.lingering notes in
  let station = Station.resume ~now:w.now ~lingering journal (Station.create (settings 0x4002)) in
  w.station <- station;
  w.own <- 0x4002;
  w.stops <- 0;
  w.notes <- [];
  hear w [ announce ];
  let goes_on = maneuvers w in
  let resumed = w.now in
  until w (resumed +. 5.);
  let fault =
    if went_on && goes_on && w.stops = 0 && maneuvers w then Some "it is not told to stop"
    else if maneuvers w && is_free w then Some "it is free"
    else if maneuvers w && Station.unsettled ~now:w.now w.station <> [ (name, "p") ] then Some "it is not named"
    else None
  in
  until w (resumed +. lasts +. 10.);
  match fault with
  | Some why -> QCheck2.Test.fail_reportf "%s" why
  | None when not (is_free w) -> QCheck2.Test.fail_report "it rests, and is not free"
  | None when Station.unsettled ~now:w.now w.station <> [] -> QCheck2.Test.fail_report "it rests, and is named"
  | None when went_on && not (List.exists (function _, Durable_note.Over _ -> true | _ -> false) w.notes) ->
    QCheck2.Test.fail_report "that it rests is not noted"
  | None -> true

let lives = QCheck2.Gen.(triple (float_range 0.5 40.) (float_range 3.5 30.) (float_range 0. 5.))

let killed =
  Test_support.Property.case ~count:200 "a vehicle that lost its plan and goes on, and a console that is killed"
    ~print:QCheck2.Print.(triple float float float) lives life

let tests = ("lingering", [ killed ])
