open Dolphin_platform_sim
open Common
open Lwt.Infix
module Virtual = Simulator.Virtual
module Paced = Simulator.Paced

let elapsed = Dolphin_runtime.Clock.system.elapsed

let pair = "vehicle 'a', { type 'UUV' }; vehicle 'b', { type 'UUV' }\nplan 'p', { duration 90 }"
let check = Alcotest.(check (list string))

let rec take next n = if n = 0 then Lwt.return [] else next () >>= fun e -> take next (n - 1) >|= fun es -> show e :: es

(* {1 Virtual time} *)

let whole_task () =
  let p = Virtual.create ~seed:1 (scenario pair) in
  let next () = Virtual.next p in
  check "announced" [ "a seen"; "b seen" ] (Lwt_main.run (take next 2));
  Virtual.start p ~number:0 "a" (task "p");
  Virtual.set_timer p 0 60.;
  Alcotest.(check (option string)) "running" (Some "p") (Virtual.running p "a");
  check "to the end" [ "timer 0"; "a seen"; "a done" ] (Lwt_main.run (take next 3));
  Alcotest.(check (float 0.)) "now" 90. (Virtual.now p);
  Alcotest.(check int) "vehicles" 2 (List.length (Virtual.vehicles p))

(* An idle platform reports so, and continues on a command. *)
let idle () =
  let p = Virtual.create ~seed:1 (scenario pair) in
  let next () = show (Lwt_main.run (Virtual.next p)) in
  Alcotest.(check bool) "announcements to come" false (Virtual.idle p);
  ignore (Lwt_main.run (take (fun () -> Virtual.next p) 2));
  Alcotest.(check bool) "idle" true (Virtual.idle p);
  Alcotest.(check string) "and says so" "quiet" (next ());
  Virtual.set_timer p 5 10.;
  Alcotest.(check bool) "not idle" false (Virtual.idle p);
  Alcotest.(check string) "commanded" "timer 5" (next ());
  Alcotest.(check string) "idle again" "quiet" (next ())

(* 1,000 vehicles, 10 tasks each: announcements, positions and ends are 21,000 events. *)
let load () =
  let vehicles = 1000 and tasks = 10 in
  let p = Virtual.create ~seed:1 (crowd vehicles) in
  let left = Hashtbl.create vehicles in
  let rec go events =
    if Virtual.idle p then Lwt.return events
    else
      Virtual.next p >>= fun event ->
      (match event with
       | Vehicle v when not (Hashtbl.mem left v.id) ->
         Hashtbl.replace left v.id tasks;
         Virtual.bind p [ v.id ];
         Virtual.start p ~number:0 v.id (task "survey")
       | Task_done id ->
         let n = Hashtbl.find left id - 1 in
         Hashtbl.replace left id n;
         if n > 0 then Virtual.start p ~number:0 id (task "survey")
       | Vehicle _ | Task_failed _ | Timer _ | Input _ | Quiet -> ());
      go (events + 1)
  in
  Alcotest.(check int) "events" (vehicles * ((2 * tasks) + 1)) (Lwt_main.run (go 0))

(* {1 Real time} *)

let paced () =
  let p = Paced.create ~speed:100. ~seed:1 (scenario pair) in
  let next () = Paced.next p in
  let began = elapsed () in
  check "announced" [ "a seen"; "b seen" ] (Lwt_main.run (take next 2));
  Paced.set_timer p 0 10.;
  check "timer" [ "timer 0" ] (Lwt_main.run (take next 1));
  let seconds = elapsed () -. began in
  Alcotest.(check bool) "a tenth of a second" true (seconds >= 0.09);
  Alcotest.(check bool) "now" true (Paced.now p >= 10.)

(* Commands while [next] waits may take effect before the awaited event. *)
let sooner () =
  let p = Paced.create ~speed:10. ~seed:1 (scenario pair) in
  ignore (Lwt_main.run (take (fun () -> Paced.next p) 2));
  Paced.set_timer p 0 600.;
  let pending = Paced.next p in
  let meanwhile = Lwt_unix.sleep 0.05 >|= fun () -> Paced.set_timer p 1 0.5 in
  let first = Lwt.pick [ pending; (Lwt_unix.sleep 5. >>= fun () -> Lwt.fail_with "too late") ] in
  Alcotest.(check string) "sooner" "timer 1" (show (Lwt_main.run (meanwhile >>= fun () -> first)));
  let pending = Paced.next p in
  Lwt.cancel pending;
  Paced.set_timer p 2 0.;
  Alcotest.(check string) "after a cancelled one" "timer 2" (show (Lwt_main.run (Paced.next p)))

(* Overdue events come in their order, at their time. *)
let late () =
  let p = Paced.create ~speed:1000. ~seed:1 (scenario pair) in
  ignore (Lwt_main.run (take (fun () -> Paced.next p) 2));
  Paced.set_timer p 1 20.;
  Paced.set_timer p 0 10.;
  Unix.sleepf 0.05;
  check "in order" [ "timer 0"; "timer 1" ] (Lwt_main.run (take (fun () -> Paced.next p) 2))

(* The time of day jumps with each look at it: it is not what passes. *)
let time_is_set () =
  let looks = ref 0 in
  let date () = incr looks; if !looks mod 2 = 0 then 0. else 7200. in
  let p = Paced.create ~clock:{ Dolphin_runtime.Clock.system with date } ~speed:100. ~seed:1 (scenario pair) in
  let began = elapsed () in
  ignore (Lwt_main.run (take (fun () -> Paced.next p) 2));
  Paced.set_timer p 0 20.;
  check "timer" [ "timer 0" ] (Lwt_main.run (take (fun () -> Paced.next p) 1));
  Alcotest.(check bool) "not early" true (elapsed () -. began >= 0.19);
  Alcotest.(check bool) "now" true (Paced.now p < 1000.)

let speeds () =
  let refused speed =
    match Paced.create ~speed ~seed:1 (scenario pair) with _ -> false | exception Invalid_argument _ -> true in
  Alcotest.(check (list bool)) "refused" [ true; true; true; false ] (List.map refused [ 0.; -1.; infinity; 0.5 ])

let () =
  Alcotest.run "simulator"
    [ ("virtual time", [ case "whole task" whole_task; case "idle" idle; case "load" load ]);
      ("real time", [ case "paced" paced; case "sooner" sooner; case "late" late;
                      case "the time is set" time_is_set; case "speeds" speeds ]) ]
