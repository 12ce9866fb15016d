open Dolphin_imc
open Dolphin_platform_imc
module State = Message.Plan_control_state

let vehicle = 0x1A
let neptus = 0x4D01
let own = 0x4ABC
let loopback = Unix.inet_addr_loopback

let settings : Station.settings =
  { id = own; name = "ccu-test"; program = ""; addresses = [ { host = loopback; port = 6001 } ]; epoch = 0.; first_request = 0;
    payload = []; types = []; type_names = []; records = false; abort_after = None;
    run = ""; jitter = 0. }

let announce name sys_type port =
  Message.Announce
    { Message.Announce.default with
      sys_name = name; sys_type; services = Printf.sprintf "imc+udp://127.0.0.1:%d/" port }

let says ?(outcome = State.Last_outcome.None) state plan_id =
  Message.Plan_control_state { State.default with state; plan_id; last_outcome = outcome }

(* What the vehicle sends on to all consoles of what Neptus asked it for. *)
let asked op = Message.Plan_control { Message.Plan_control.default with type_ = Request; op; request_id = 77 }

let missions =
  Alcotest.test_case "a mission of items is refused, and nothing is sent" `Quick (fun () ->
      let hear s (now, src, message) =
        let packet = Packet.make ~src ~dst:Header.nobody ~timestamp:now message in
        fst (Station.datagram ~now ~from:loopback (Result.get_ok (Packet.encode packet)) s)
      in
      let s = List.fold_left hear (Station.create settings)
          [ (0., vehicle, announce "lauv-1" Uuv 6002); (0.5, vehicle, says Ready "q") ] in
      let mission = { Dolphin_plans.Mission_plan.name = "p"; vehicles = []; items = [] } in
      let s, sent = Station.start ~now:1. "lauv-1" { name = "p"; plan = Some (Mission mission); task_site = 0 } s in
      let rec failures s =
        match Station.take s with
        | Some (Task_failed (v, why), s) -> (v, why) :: failures s
        | Some (_, s) -> failures s
        | None -> []
      in
      Alcotest.(check int) "sent" 0 (List.length sent);
      Alcotest.(check (list (pair string string))) "failed"
        [ ("lauv-1", "IMC vehicles take no missions of items: describe the plan by imcPlan { ... }") ] (failures s))

(* The failures of plan [p], which is started at 1 s, after these messages: when, from whom, to whom; and remarks. *)
let play ?(payload = []) ?(before = []) messages =
  let remarks = ref [] in
  let hear s (now, src, dst, message) =
    let packet = Packet.make ~src ~dst ~timestamp:now message in
    let s, outputs = Station.datagram ~now ~from:loopback (Result.get_ok (Packet.encode packet)) s in
    let remark : Station.output -> unit = function
      | Remark (_, text) -> remarks := text :: !remarks
      | Send _ | Announce _ | Announce_to _ | Keep _ -> ()
    in
    List.iter remark outputs;
    s
  in
  let introduced =
    [ (0., vehicle, 0, announce "lauv-1" Uuv 6002); (0., neptus, 0, announce "ccu-neptus" Ccu 6003);
      (0.5, vehicle, Header.nobody, says Ready "q") ]
  in
  let s = List.fold_left hear (Station.create { settings with payload }) (introduced @ before) in
  let s, sent = Station.start ~now:1. "lauv-1" { name = "p"; plan = None; task_site = 0 } s in
  let request = function
    | Station.Send { bytes; _ } -> (
        match Packet.decode bytes with
        | Ok { content = Message (Plan_control c); _ } -> Some c
        | Ok _ | Error _ -> None)
    | Announce _ | Announce_to _ | Keep _ | Remark _ -> None
  in
  let start = List.hd (List.filter_map request sent) in
  let taken = Message.Plan_control { start with type_ = Success; info = "plan loaded"; arg = None } in
  let s = List.fold_left hear s ((1.1, vehicle, own, taken) :: messages) in
  let rec told s =
    match Station.take s with
    | Some (Task_failed (_, why), s) -> why :: told s
    | Some (_, s) -> told s
    | None -> []
  in
  let failures = told (fst (Station.tick ~now:10. s)) in
  (failures, List.rev !remarks)

let case name messages expected =
  Alcotest.test_case name `Quick (fun () -> Alcotest.(check (list string)) name expected (fst (play messages)))

let remarks name ?payload ?before messages expected =
  Alcotest.test_case name `Quick (fun () ->
      Alcotest.(check (list string)) name expected (snd (play ?payload ?before messages)))

let error ?(context = "Payload") at text =
  (at, vehicle, Header.nobody,
   Message.Log_book_entry { Message.Log_book_entry.default with type_ = Error; context; text })

let lists devices =
  let list = String.concat ";" (List.mapi (fun i d -> Printf.sprintf "%s=%d" d i) devices) in
  (2., vehicle, own, Message.Entity_list { op = Report; list })


let executes = (1.2, vehicle, Header.nobody, says Executing "p")
let fails = (3.1, vehicle, Header.nobody, says ~outcome:Failure Ready "p")
let succeeds = (3.1, vehicle, Header.nobody, says ~outcome:Success Ready "p")
let no_reason = "the plan ended without success, and the vehicle gave no reason"

let tests =
  ( "interventions",
    [ missions;
      case "another console stops the plan" [ executes; (3., neptus, vehicle, asked Stop); fails ]
        [ "stopped by ccu-neptus" ];
      case "the vehicle's report overtakes the request" [ executes; fails; (3.3, neptus, vehicle, asked Stop) ]
        [ "stopped by ccu-neptus" ];
      case "a console that has not announced itself" [ executes; (3., 0x4D02, vehicle, asked Stop); fails ]
        [ "stopped by system 0x4d02" ];
      case "requests to start, or to other vehicles"
        [ executes; (2., neptus, vehicle, asked Start); (3., neptus, 0x1B, asked Stop); fails ]
        [ no_reason ];
      case "nobody has" [ executes; fails ] [ no_reason ];
      remarks "an error of the log book, once" [ executes; error 2. "invalid parameter"; error 2.5 "invalid parameter" ]
        [ "error of Payload: invalid parameter" ];
      remarks "an error that was there before the plan" ~before:[ error 0.6 "no socket" ]
        [ executes; error 4. "no socket" ] [];
      remarks "replies are told as the failure" [ executes; error ~context:"Plan.Engine" 3. "reply -- Start Plan (p) -- x" ]
        [];
      remarks "an error after the plan" [ executes; succeeds; error 4. "late" ] [];
      remarks "no end of errors" (executes :: List.init 200 (fun i -> error 2. (string_of_int i)))
        (List.init 50 (fun i -> Printf.sprintf "error of Payload: %d" i));
      remarks "a device that the vehicle does not list" ~payload:[ ("lauv-1", [ "DVL"; "Camera" ]) ]
        [ lists [ "dvl"; "CPU" ]; lists [ "dvl" ] ]
        [ "does not list Camera among its entities, as --imc-payload has it" ];
      remarks "a vehicle that nothing is claimed of" ~payload:[ ("lauv-2", [ "Camera" ]) ] [ lists [ "DVL" ] ] [] ] )
