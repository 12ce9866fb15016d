open Dolphin_platform_sim
open Common
module Platform = Dolphin_runtime.Platform

(* Unreliable vehicles, and an unknown one. *)
let fleet =
  scenario
    "vehicle 'a', { type 'UUV'; drops 5, 15; drops 30, 40; drops 80, 12; drops 200, 100\n\
    \              battery 3.percent; drain 50.percent }\n\
     vehicle 'b', { type 'UAV'; joins 20; leaves 250; charge 90.percent }\n\
     vehicle 'c', { type 'UUV'; drain 0 }\n\
     plan 'quick', { duration 0, 20; mayFail 30.percent; at 41.2, -8.7 }\n\
     plan 'slow', { duration 3.min, 9.min; mayFail 30.percent }"

let ids = [ "a"; "b"; "c"; "x" ]

type command =
  | Start of string * string
  | Stop of string
  | Set of int * float
  | Cancel of int
  | Hold of string
  | Let_go of string
  | Timeout of string option * float
  | Telemetry of bool
  | Steps of int                                (* the number of events *)

let show_command = function
  | Start (v, name) -> Printf.sprintf "start %s %s" v name
  | Stop v -> "stop " ^ v
  | Set (timer, seconds) -> Printf.sprintf "set %d %g" timer seconds
  | Cancel timer -> Printf.sprintf "cancel %d" timer
  | Hold v -> "bind " ^ v
  | Let_go v -> "release " ^ v
  | Timeout (v, seconds) -> Printf.sprintf "timeout %s %g" (Option.value v ~default:"all") seconds
  | Telemetry on -> Printf.sprintf "telemetry %b" on
  | Steps n -> Printf.sprintf "steps %d" n

let command =
  let open QCheck2.Gen in
  let vehicle = oneofl ids and timer = int_bound 3 and seconds = map float_of_int (int_bound 100) in
  frequency
    [ (4, map2 (fun v name -> Start (v, name)) vehicle (oneofl [ "quick"; "slow"; "other"; "way" ]));
      (2, map (fun v -> Stop v) vehicle); (1, map2 (fun timer n -> Set (timer, n)) timer seconds);
      (1, map (fun timer -> Cancel timer) timer); (1, map (fun v -> Hold v) vehicle);
      (1, map (fun v -> Let_go v) vehicle); (1, map2 (fun v n -> Timeout (v, n)) (opt vehicle) seconds);
      (1, map (fun on -> Telemetry on) bool);
      (6, map (fun n -> Steps n) (int_range 1 8)) ]

(* The driver's expectations: the tasks and the timers that it still waits for. *)
type expectation = { fleet : Fleet.t; tasks : string list; timers : int list }

exception Broken of string

let require what holds = if not holds then raise (Broken what)
let without x = List.filter (fun y -> y <> x)

let hear e event =
  match (event : Platform.event) with
  | Vehicle state ->
    require "a battery between empty and full" (match state.battery with Some share -> share >= 0. && share <= 1. | None -> false);
    require "a vehicle of the scenario" (state.id <> "x");
    e
  | Task_done v | Task_failed (v, _) ->
    require "a task that was started, and neither stopped nor told of before" (List.mem v e.tasks);
    require "nothing running afterwards" (Fleet.running e.fleet v = None);
    { e with tasks = without v e.tasks }
  | Timer timer ->
    require "a timer that was set" (List.mem timer e.timers);
    { e with timers = without timer e.timers }
  | Input _ -> raise (Broken "nobody posts here")
  | Quiet -> raise (Broken "the fleet itself does not say that it is quiet")

let step e =
  let before = Fleet.now e.fleet and due = Fleet.due e.fleet and quiet = Fleet.quiet e.fleet in
  match Fleet.step e.fleet with
  | None ->
    require "nothing due" (due = None && quiet);
    e
  | Some (event, fleet) ->
    require "time goes forward" (Fleet.now fleet >= before);
    require "things happen when they are due" (due = Some (Fleet.now fleet));
    require "quiet means quiet" (not (quiet && event <> None));
    let e = { e with fleet } in
    Option.fold event ~none:e ~some:(hear e)

let way = go_to ~dwell:20. [ { Dolphin_geo.Place.apdl with latitude = 41.186 } ]

let rec obey e = function
  | Start (v, _) when List.mem v e.tasks -> e
  | Start (v, name) ->
    let plan = if name = "way" then Some way else None in
    let fleet = Fleet.start v (task ?plan name) e.fleet in
    require "it runs" (Fleet.running fleet v = Some name);
    { e with fleet; tasks = v :: e.tasks }
  | Stop v -> { e with fleet = Fleet.stop v e.fleet; tasks = without v e.tasks }
  | Set (timer, n) -> { e with fleet = Fleet.set_timer timer n e.fleet; timers = timer :: without timer e.timers }
  | Cancel timer -> { e with fleet = Fleet.cancel_timer timer e.fleet; timers = without timer e.timers }
  | Hold v -> { e with fleet = Fleet.bind [ v ] e.fleet }
  | Let_go v -> { e with fleet = Fleet.release [ v ] e.fleet }
  | Timeout (v, n) -> { e with fleet = Fleet.set_connection_timeout (Option.map (fun v -> [ v ]) v) n e.fleet }
  | Telemetry on -> { e with fleet = Fleet.telemetry (if on then Awaited else Off) e.fleet }
  | Steps n -> if n = 0 then e else obey (step e) (Steps (n - 1))

(* At last all that was started ends, and the platform falls silent. *)
let drain e =
  let e = obey e (Telemetry false) in
  let rec go fuel e =
    require "an end" (fuel > 0);
    if Fleet.due e.fleet = None then e else go (fuel - 1) (step e)
  in
  let e = go 10_000 e in
  require "every task and every timer is heard of" (e.tasks = [] && e.timers = []);
  require "nothing runs" (List.for_all (fun v -> Fleet.running e.fleet v = None) ids)

let laws =
  law ~count:5000 "a platform keeps its promises"
    QCheck2.Gen.(pair small_nat (list_size (int_range 1 120) command))
    ~print:QCheck2.Print.(pair int (list show_command))
    (fun (seed, commands) ->
       let start = { fleet = Fleet.create ~seed fleet; tasks = []; timers = [] } in
       drain (List.fold_left obey start commands);
       true)

let () = Alcotest.run "commands" [ ("laws", [ laws ]) ]
