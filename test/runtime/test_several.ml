open Dolphin_semantics
open Dolphin_runtime

let case name test = Alcotest.test_case name `Quick test
let strings = Alcotest.(list string)
let task name : Core.platform_task = { name; plan = None; task_site = 0 }

(* Two platforms, "first" and "second", with these events at the start. *)
type both = {
  first : Mock_platform.t;
  second : Mock_platform.t;
  several : Several.t;
  mutable notes : string list;
  mutable kept : (Core.vehicle * Yojson.Safe.t) list;
}

let both ?(owners = []) first second =
  let at_once events = Mock_platform.make (List.map (fun event -> (0., event)) events) in
  let first = at_once first and second = at_once second in
  let part mock = Several.Part ((module Mock_platform.Virtual), mock) in
  let rec b =
    lazy
      { first; second; notes = []; kept = [];
        several =
          Several.make ~owners
            ~note:(fun v text -> let b = Lazy.force b in b.notes <- (v ^ " " ^ text) :: b.notes)
            ~keep:(fun ~time:_ v data -> let b = Lazy.force b in b.kept <- (v, data) :: b.kept)
            [ ("first", part first); ("second", part second) ] }
  in
  Lazy.force b

let seen ?connected id : Platform.event = Vehicle (Mock_platform.vehicle ?connected id)

let describe : Platform.event -> string = function
  | Vehicle { id; unready = Some why; _ } -> Printf.sprintf "%s %s" id why
  | Vehicle { id; connected; _ } -> if connected then id else id ^ " has no link"
  | Task_done v -> v ^ " is done"
  | Task_failed (v, why) -> Printf.sprintf "%s failed: %s" v why
  | Timer timer -> Printf.sprintf "timer %d" timer
  | Input (key, _) -> "input " ^ key
  | Quiet -> "quiet"

(* The next [n] events. All that these platforms have is there at once. *)
let events b n =
  let next _ =
    match Lwt.state (Several.next b.several) with
    | Return event -> describe event
    | Fail error -> raise error
    | Sleep -> "none"
  in
  List.map next (List.init n Fun.id)

let check_log name expected mock = Alcotest.check strings name expected (Mock_platform.log mock)

let commands () =
  let b = both [ seen "a" ] [ seen "b"; seen "c" ] in
  ignore (events b 3);
  Several.bind b.several [ "a"; "b"; "c" ];
  Several.start b.several ~number:0 "b" (task "p");
  Several.set_connection_timeout b.several None 5.;
  Several.set_connection_timeout b.several (Some [ "a"; "c" ]) 7.;
  Several.stop b.several "b";
  Several.release b.several [ "c"; "b" ];
  Several.telemetry b.several Awaited;
  check_log "of the first" [ "0 bind a"; "0 timeout all 5"; "0 timeout a 7"; "0 telemetry true" ] b.first;
  check_log "of the second"
    [ "0 bind b c"; "0 start b p"; "0 timeout all 5"; "0 timeout c 7"; "0 stop b"; "0 release c b"; "0 telemetry true" ]
    b.second;
  ignore (Several.close b.several);
  let closed mock = List.mem "0 close" (Mock_platform.log mock) in
  Alcotest.(check (pair bool bool)) "both are closed" (true, true) (closed b.first, closed b.second)

let timers_are_of_the_first () =
  let b = both [] [ Timer 7; Quiet; seen "b" ] in
  Several.set_timer b.several 7 0.;
  Alcotest.check strings "one expiry, and no end of what happens" [ "timer 7"; "b"; "none" ] (events b 3);
  Several.set_timer b.several 8 0.;
  Several.cancel_timer b.several 8;
  Alcotest.check strings "none that was cancelled" [ "none" ] (events b 1)

let others_do_not_end_tasks () =
  let b = both [ seen "a"; Task_failed ("b", "no such vehicle") ] [ seen "b"; Task_done "a"; Task_done "b" ] in
  Alcotest.check strings "only its own platform ends a task" [ "a"; "b"; "b is done"; "none" ] (events b 4)

let a_stop_overtakes () =
  let b = both [ seen "a"; seen "a" ] [ seen "b"; Task_done "b" ] in
  Alcotest.check strings "up to the end, which was reported and not read" [ "a"; "b"; "a" ] (events b 3);
  Several.stop b.several "b";
  Alcotest.check strings "which does not come after the stop" [ "none" ] (events b 1)

let offered_by_both () =
  let why = "is offered by first and by second" in
  let b = both [ seen "a"; seen "a"; seen ~connected:false "a"; seen "a" ] [ seen "a" ] in
  Alcotest.check strings "not ready as long as both offer it"
    [ "a"; "a " ^ why; "a " ^ why; "a"; "a " ^ why; "none" ] (events b 6);
  let note = Printf.sprintf "a %s: it cannot be picked until only one does" why in
  Alcotest.check strings "one note each time" [ note; note ] b.notes

let owners_change () =
  let gone = seen ~connected:false "a" in
  let free = both [ seen "a"; gone ] [ seen "a" ] in
  ignore (events free 3);
  Several.start free.several ~number:0 "a" (task "p");
  check_log "of one that is free, by another one that offers it" [ "0 start a p" ] free.second;
  let held = both [ seen "a"; gone ] [ seen "a" ] in
  ignore (events held 1);
  Several.bind held.several [ "a" ];
  ignore (events held 2);
  Several.start held.several ~number:0 "a" (task "p");
  check_log "not of one that the program holds" [ "0 bind a"; "0 start a p" ] held.first;
  check_log "not of one that the program holds" [] held.second

let kept () =
  let b = both [ seen "a" ] [ seen "b" ] in
  ignore (events b 2);
  Several.bind b.several [ "a"; "b" ];
  let note (v, data) : History.entry = { time = 0.; what = Noted (v, data) } in
  let other : History.entry = { time = 0.; what = Noted ("c", `Assoc [ ("plan", `Int 1) ]) } in
  let owners = Several.owners ~imc:"first" (List.rev_map note b.kept @ [ other ]) in
  Alcotest.(check (list (pair string string))) "the platform of each" [ ("a", "first"); ("b", "second"); ("c", "first") ]
    (List.sort compare owners);
  let resumed = both ~owners [] [] in
  Several.stop resumed.several "b";
  check_log "after a resumption, before it is heard of" [ "0 stop b" ] resumed.second

(* However many events a platform has. *)
let they_take_turns () =
  let flood = List.init 1_000 (fun _ -> seen "a") in
  let one_beside_a_flood b =
    ignore (events b 1);
    Alcotest.(check bool) "the end is among the next events" true (List.mem "b is done" (events b 4))
  in
  one_beside_a_flood (both flood [ seen "b"; Task_done "b" ]);
  one_beside_a_flood (both [ seen "b"; Task_done "b" ] flood)

let tests =
  [ case "commands go to the platform of the vehicle" commands;
    case "the first platform has the timers" timers_are_of_the_first;
    case "a platform ends the tasks of its own vehicles" others_do_not_end_tasks;
    case "the end of a task that is stopped is not reported" a_stop_overtakes;
    case "a vehicle that both offer" offered_by_both;
    case "a vehicle whose platform has gone" owners_change;
    case "the platforms of a run that is resumed" kept;
    case "platforms take turns" they_take_turns ]
