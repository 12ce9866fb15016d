open Dolphin_runtime
open Dolphin_platform_imc
open Lwt.Infix

let contains text part =
  let n = String.length part in
  let rec from i = i + n <= String.length text && (String.sub text i n = part || from (i + 1)) in
  from 0

(* Each test has ports of its own: others may run at the same time. *)
let next_port = ref (Test_support.Ports.lease ())

let ports () =
  next_port := !next_port + 2;
  [ !next_port; !next_port + 1 ]

let open_exn options =
  match Udp_platform.open_ options with Ok p -> p | Error why -> Alcotest.fail why

let options ?(note = fun _ _ -> ()) announce_ports =
  { Udp_platform.default with loopback = true; announce_ports; note; close_patience = 3. }

let limited seconds promise =
  Lwt.pick [ promise; (Lwt_unix.sleep seconds >>= fun () -> Alcotest.failf "took longer than %g s" seconds) ]

let said = ref []

let console =
  { Console.say = (fun text -> said := text :: !said); ask = (fun _ -> Lwt.return (Error "nobody")); refused = ignore }

let run_program ?observer ~seconds platform source =
  said := [];
  let program = Test_support.Pure_run.compile_exn source in
  let never, _ = Lwt.wait () in
  limited seconds (Driver.run (module Udp_platform) platform ?observer ~console ~interruption:never program)

let outcome =
  let text = Format.asprintf "%a" Driver.pp_outcome in
  Alcotest.testable Driver.pp_outcome (fun a b -> text a = text b)

let in_a_world name f = Alcotest.test_case name `Quick (fun () -> Lwt_main.run (f ()))
let fates table plan = Option.value (List.assoc_opt plan table) ~default:(Vehicle_model.Is_refused "undefined plan")
let quick = Vehicle_model.Succeeds 0.1

let program =
  in_a_world "a program: plans after one another and at once, a refused one, a stop" (fun () ->
      let announce_ports = ports () in
      let fate = fates [ ("survey", quick); ("patrol", Succeeds 0.3); ("long", Succeeds 60.) ] in
      let vehicle id name = Udp_vehicle.start ~announce_ports ~id ~name ~fate () in
      let platform = open_exn (options announce_ports) in
      let a = vehicle 0x1A "noptilus-1" and b = vehicle 0x1B "noptilus-2" in
      run_program ~seconds:20. platform
        {|
v = pick { count 2; type 'UUV'; payload 'DVL'; timeout 10.seconds }
execute imcPlan('survey')[v] >> imcPlan('survey')[v]
execute imcPlan('survey') | imcPlan('patrol')
execute watch imcPlan('nowhere') onError { e -> message "failed: ${e}"; ignore() }
execute during 1.second run imcPlan('long')
execute imcPlan('patrol')
message 'over'
|}
      >>= fun result ->
      Alcotest.check outcome "ends" (Driver.Ended Completed) result;
      let executions v = Vehicle_model.executions (Udp_vehicle.model v) in
      let names =
        List.sort compare (List.map (fun (e : Vehicle_model.execution) -> e.plan) (executions a @ executions b))
      in
      Alcotest.(check (list string)) "each once" [ "long"; "patrol"; "patrol"; "survey"; "survey"; "survey" ] names;
      Alcotest.(check (list string)) "said" [ "over" ] (List.filter (fun s -> s = "over") !said);
      Alcotest.(check bool) "told why" true
        (List.exists (fun s -> contains s "undefined plan") !said);
      Lwt.join [ Udp_vehicle.stop a; Udp_vehicle.stop b ])

let bad_network =
  in_a_world "30% loss, 10% duplication, reordering both ways: the mission completes" (fun () ->
      let announce_ports = ports () in
      let quality = { Network.loss = 0.3; duplication = 0.1; delay = 0.05 } in
      let fate = fates [ ("survey", Vehicle_model.Succeeds 0.5); ("patrol", Succeeds 0.7) ] in
      let vehicle id name = Udp_vehicle.start ~quality ~seed:7 ~announce_ports ~id ~name ~fate () in
      let platform = open_exn (options announce_ports) in
      let a = vehicle 0x1A "noptilus-1" and b = vehicle 0x1B "noptilus-2" in
      run_program ~seconds:60. platform
        {|
v = pick { count 2; type 'UUV'; timeout 30.seconds }
execute imcPlan('survey') | imcPlan('patrol')
execute imcPlan('patrol') | imcPlan('survey')
|}
      >>= fun result ->
      Alcotest.check outcome "ends" (Driver.Ended Completed) result;
      Lwt.join [ Udp_vehicle.stop a; Udp_vehicle.stop b ])

let vanished =
  in_a_world "a vehicle that vanishes fails its plan" (fun () ->
      let announce_ports = ports () in
      let platform = open_exn (options announce_ports) in
      let fate = fates [ ("long", Vehicle_model.Succeeds 60.) ] in
      let a = Udp_vehicle.start ~announce_ports ~id:0x1A ~name:"noptilus-1" ~fate () in
      Lwt.async (fun () -> Lwt_unix.sleep 2. >>= fun () -> Udp_vehicle.stop a);
      run_program ~seconds:30. platform
        {|
v = pick { type 'UUV'; timeout 10.seconds }
setConnectionTimeout 5
execute imcPlan('long')
|}
      >>= function
      | Driver.Ended (Failed fault) ->
        Alcotest.(check bool) "why" true (contains fault.message "no word from the vehicle for 5 seconds");
        Lwt.return_unit
      | other -> Alcotest.failf "%a" Driver.pp_outcome other)

exception Disk_full

(* The vehicle's answer to the first START cannot be kept. That is no reason not to see its stop through. *)
let journal_breaks =
  in_a_world "what cannot be kept ends the run, and vehicles are stopped" (fun () ->
      let announce_ports = ports () in
      let notes = ref [] in
      let note vehicle text = notes := (vehicle, text) :: !notes in
      let is_answer note = match Durable_note.of_json note with Some (Taken _ | Runs _) -> true | _ -> false in
      let keep ~time:_ _ note = if is_answer note then raise Disk_full in
      let platform = open_exn { (options ~note announce_ports) with keep } in
      let quality = { Network.loss = 0.3; duplication = 0.; delay = 0. } in
      let fate = fates [ ("long", Vehicle_model.Succeeds 60.) ] in
      let vehicle id name = Udp_vehicle.start ~quality ~seed:id ~announce_ports ~id ~name ~fate () in
      let a = vehicle 0x1A "noptilus-1" and b = vehicle 0x1B "noptilus-2" in
      let run () =
        run_program ~seconds:20. platform
          {|
v = pick { count 2; type 'UUV'; timeout 10.seconds }
execute imcPlan('long') | imcPlan('long')
|}
      in
      Lwt.catch
        (fun () -> run () >>= fun outcome -> Alcotest.failf "%a" Driver.pp_outcome outcome)
        (function Disk_full -> Lwt.return_unit | error -> Lwt.fail error)
      >>= fun () ->
      Alcotest.(check (list (pair string string))) "all stops are confirmed" [] !notes;
      Lwt.join [ Udp_vehicle.stop a; Udp_vehicle.stop b ])

(* A request must not be taken for lost while it waits for the disk: it would come twice. *)
let slow_disk =
  in_a_world "a disk that is slow: requests wait for it, together, and each leaves once" (fun () ->
      let announce_ports = ports () in
      let began = ref [] in
      let sync () =
        began := Clock.system.elapsed () :: !began;
        Lwt_unix.sleep 2.5
      in
      let platform = open_exn { (options announce_ports) with sync = Some sync } in
      let fate = fates [ ("long", Vehicle_model.Succeeds 0.5) ] in
      let vehicle i = Udp_vehicle.start ~announce_ports ~id:(100 + i) ~name:(Printf.sprintf "v%d" i) ~fate () in
      let vehicles = List.init 3 vehicle in
      run_program ~seconds:20. platform
        {|
v = pick { count 3; type 'UUV'; timeout 10.seconds }
execute imcPlan('long') | imcPlan('long') | imcPlan('long')
|}
      >>= fun result ->
      Alcotest.check outcome "ends" (Driver.Ended Completed) result;
      Alcotest.(check int) "one turn of the disk" 1 (List.length !began);
      let starts = List.map Udp_vehicle.starts vehicles in
      Alcotest.(check (list int)) "each once" [ 1; 1; 1 ] (List.map List.length starts);
      let since_disk = List.concat_map (List.map (fun (time, _) -> time -. List.hd !began)) starts in
      Alcotest.(check bool) "not before" true (List.for_all (fun seconds -> seconds >= 2.4) since_disk);
      Lwt.join (List.map Udp_vehicle.stop vehicles))

let broken_disk =
  in_a_world "a disk that fails: no request leaves" (fun () ->
      let announce_ports = ports () in
      let notes = ref [] in
      let note vehicle text = notes := (vehicle, text) :: !notes in
      let sync () = Lwt_unix.sleep 0.2 >>= fun () -> Lwt.fail Disk_full in
      let platform = open_exn { (options ~note announce_ports) with sync = Some sync } in
      let fate = fates [ ("long", Vehicle_model.Succeeds 60.) ] in
      let a = Udp_vehicle.start ~announce_ports ~id:0x1A ~name:"noptilus-1" ~fate () in
      let run () =
        run_program ~seconds:20. platform "v = pick { timeout 10.seconds }; execute imcPlan('long')"
      in
      Lwt.catch
        (fun () -> run () >>= fun outcome -> Alcotest.failf "%a" Driver.pp_outcome outcome)
        (function Disk_full -> Lwt.return_unit | error -> Lwt.fail error)
      >>= fun () ->
      Alcotest.(check int) "no start" 0 (List.length (Udp_vehicle.starts a));
      Alcotest.(check (list (pair string string))) "nothing is left open" [] !notes;
      Udp_vehicle.stop a)

(* An NTP step on the machine of the console and the vehicles: the time of day jumps an hour forward, and later back. *)
let time_is_set =
  in_a_world "the time of day jumps an hour forward and back: no vehicle is lost, no timer fires early" (fun () ->
      let announce_ports = ports () in
      let start = Clock.system.elapsed () in
      let jump () =
        let seconds = Clock.system.elapsed () -. start in
        if seconds < 2. then 0. else if seconds < 4. then 3600. else if seconds < 5. then -3600. else 0.
      in
      let clock = { Clock.system with date = (fun () -> Unix.gettimeofday () +. jump ()) } in
      let notes = ref [] in
      let note vehicle text = notes := (vehicle, text) :: !notes in
      let platform = open_exn { (options ~note announce_ports) with clock } in
      let fate = fates [ ("survey", Vehicle_model.Succeeds 0.3); ("long", Succeeds 60.); ("patrol", Succeeds 1.5) ] in
      let a = Udp_vehicle.start ~date:clock.date ~announce_ports ~id:0x1A ~name:"noptilus-1" ~fate () in
      let links = ref [] in
      let news ~time:_ (state : Dolphin_semantics.World.vehicle_state) =
        if !links = [] || List.hd !links <> state.connected then links := state.connected :: !links
      in
      run_program ~observer:{ Observer.nobody with news } ~seconds:20. platform
        {|
v = pick { type 'UUV'; timeout 10.seconds }
setConnectionTimeout 5
execute imcPlan('patrol') >> imcPlan('survey') >> imcPlan('patrol')
execute during 3.seconds run imcPlan('long')
execute imcPlan('survey')
|}
      >>= fun result ->
      Alcotest.check outcome "ends" (Driver.Ended Completed) result;
      Alcotest.(check bool) "all jumps were lived through" true (Clock.system.elapsed () -. start > 5.5);
      Alcotest.(check (list bool)) "the link comes, and stays" [ false; true ] (List.rev !links);
      Alcotest.(check (list (pair string string))) "nothing to remark" [] !notes;
      let starts = List.rev (Udp_vehicle.starts a) in
      let plans = [ "patrol"; "survey"; "patrol"; "long"; "survey" ] in
      Alcotest.(check (list string)) "each once" plans (List.map snd starts);
      let time i = fst (List.nth starts i) in
      let during = time 4 -. time 3 in
      Alcotest.(check bool) "three seconds are three seconds" true (during >= 2.9 && during < 4.5);
      Udp_vehicle.stop a)

(* [f ()], and what the source [name] logs meanwhile at the level Debug, in order. *)
let logged name f =
  let source = List.find (fun s -> Logs.Src.name s = name) (Logs.Src.list ()) in
  let lines = ref [] and reporter = Logs.reporter () in
  let report src _ ~over k message =
    let keep text = if Logs.Src.equal src source then lines := text :: !lines; over (); k () in
    message (fun ?header:_ ?tags:_ format -> Format.kasprintf keep format)
  in
  Logs.set_reporter { Logs.report };
  Logs.Src.set_level source (Some Debug);
  let restore () =
    Logs.set_reporter reporter;
    Logs.Src.set_level source None;
    Lwt.return_unit
  in
  Lwt.finalize f restore >|= fun result ->
  (result, List.rev !lines)

let debug_log =
  in_a_world "the debug log tells datagrams, changes of vehicles, timers" (fun () ->
      let announce_ports = ports () in
      let fate = fates [ ("survey", Vehicle_model.Succeeds 0.5) ] in
      let platform = open_exn (options announce_ports) in
      let a = Udp_vehicle.start ~announce_ports ~id:0x1A ~name:"noptilus-1" ~fate () in
      logged "dolphin.imc" (fun () ->
          run_program ~seconds:20. platform "v = pick { timeout 10.seconds }; execute imcPlan('survey')")
      >>= fun (result, lines) ->
      Alcotest.check outcome "ends" (Driver.Ended Completed) result;
      let is_told parts =
        let all line = List.for_all (contains line) parts in
        Alcotest.(check bool) (String.concat " .. " parts) true (List.exists all lines)
      in
      is_told [ "noptilus-1: link, mode "; ", running plan survey" ];
      List.iter (fun part -> is_told [ part ])
        [ "in from 127.0.0.1: Announce from 0x001a"; "in from 127.0.0.1: PlanControlState from 0x001a";
          ": PlanControl from 0x"; "timer 0 set: 10 s"; "noptilus-1 is done" ];
      Udp_vehicle.stop a)

let nobody =
  in_a_world "nobody is there" (fun () ->
      let platform = open_exn (options (ports ())) in
      run_program ~seconds:5. platform "v = pick { timeout 1.second }" >>= function
      | Driver.Ended (Halted _ | Failed _) -> Lwt.return_unit
      | other -> Alcotest.failf "%a" Driver.pp_outcome other)

let taken =
  in_a_world "all ports are taken" (fun () ->
      let announce_ports = ports () in
      let first = open_exn (options announce_ports) and second = open_exn (options announce_ports) in
      (match Udp_platform.open_ (options announce_ports) with
       | Ok _ -> Alcotest.fail "a third console"
       | Error why -> Alcotest.(check bool) "why" true (contains why "ports for announcements"));
      Lwt.join [ Udp_platform.close first; Udp_platform.close second ])

let many =
  in_a_world "20 vehicles, and the time from the end of a plan to the next start" (fun () ->
      let announce_ports = ports () in
      let fate = fates [ ("a", Vehicle_model.Succeeds 0.5); ("b", quick) ] in
      let vehicle i = Udp_vehicle.start ~announce_ports ~id:(100 + i) ~name:(Printf.sprintf "v%02d" i) ~fate () in
      let platform = open_exn (options announce_ports) in
      let vehicles = List.init 20 vehicle in
      run_program ~seconds:30. platform
        {|
v = pick { count 20; type 'UUV'; timeout 10.seconds }
task1 = task('a') >> task('b') >> task('a') >> task('b')
all = task1
for (i in 2..20) { all = all | task1 }
execute all
|}
      >>= fun result ->
      Alcotest.check outcome "ends" (Driver.Ended Completed) result;
      let gaps v =
        let ends = List.rev (Udp_vehicle.ends v) and starts = List.rev (Udp_vehicle.starts v) in
        Alcotest.(check int) "each once" 4 (List.length starts);
        List.map2 (fun (e, _) (s, _) -> s -. e) (List.filteri (fun i _ -> i < 3) ends) (List.tl starts)
      in
      let all = List.sort compare (List.concat_map gaps vehicles) in
      let at share = List.nth all (int_of_float (share *. float_of_int (List.length all - 1))) in
      Printf.printf "end to next start: median %.1f ms, 99%% %.1f ms\n" (1000. *. at 0.5) (1000. *. at 0.99);
      Lwt.join (List.map Udp_vehicle.stop vehicles))

let tests =
  ( "network",
    [ program; bad_network; vanished; journal_breaks; slow_disk; broken_disk; time_is_set; debug_log; nobody; taken;
      many ] )
