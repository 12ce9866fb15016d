open Dolphin_imc
open Dolphin_platform_imc

(* A console that runs plans one after another, and closes when they are over or one of them has failed. *)
type console = {
  first_request : int;
  mutable execution : Execution.t;
  mutable clock : Vehicle_clock.t;
  mutable plans : string list;  (* still to run *)
  waits : float;  (* begins at that time, once the vehicle says READY *)
  mutable is_ready : bool;  (* the vehicle's last word *)
  mutable phase : [ `Waits | `Runs | `Closes of float | `Closed of string option ];
  mutable failure : string option;
  out : (console * Message.t Message.Plan_control.t) Network.t;
  back : (float * Message.t) Network.t;
}

let close_patience = 5.
let instant = 0.01

let console ~random ~quality ~first_request ~waits plans =
  { first_request; execution = Execution.create ~request:first_request (); clock = Vehicle_clock.unknown; plans; waits;
    is_ready = false; phase = `Waits; failure = None; out = Network.create random quality;
    back = Network.create random quality }

let rec input ~now c i =
  let execution, outputs = Execution.step ~now ~clock:c.clock i c.execution in
  c.execution <- execution;
  List.iter (carry_out ~now c) outputs

and carry_out ~now c : Execution.output -> unit = function
  | Send (Plan_control request) -> Network.send ~now (c, request) c.out
  | Send _ | Keep _ | Remark _ -> ()
  | Done -> next ~now c
  | Failed why ->
    c.failure <- Some why;
    c.phase <- `Closes now

and next ~now c =
  match c.plans with
  | [] -> c.phase <- `Closes now
  | plan :: plans ->
    c.plans <- plans;
    c.phase <- `Runs;
    input ~now c (Start { plan; specification = None })

let hear ~now c (stamp, (message : Message.t)) =
  let clock, sent = Vehicle_clock.observe ~now ~sent:stamp c.clock in
  c.clock <- clock;
  match message with
  | Plan_control reply -> input ~now c (Reply { sent; reply })
  | Plan_control_state state ->
    c.is_ready <- state.state = Ready;
    input ~now c (State { sent; state })
  | Vehicle_state state -> input ~now c (Vehicle { sent; state })
  | Log_book_entry entry -> input ~now c (Log { sent; entry })
  | _ -> ()

(* As {!Udp_platform.close} does. *)
let live ~now c =
  let hear_unless_closed message = match c.phase with `Closed _ -> () | _ -> hear ~now c message in
  List.iter hear_unless_closed (Network.arrived ~now c.back);
  (match c.phase with
   | `Closed _ -> ()
   | `Waits | `Runs | `Closes _ -> if Execution.due c.execution <= now then input ~now c Tick);
  match c.phase with
  | `Waits when now >= c.waits && c.is_ready -> next ~now c
  | `Closes since ->
    if Execution.is_settled ~now c.execution then c.phase <- `Closed None
    else if now >= since +. close_patience then c.phase <- `Closed (Execution.unsettled ~now c.execution)
  | `Waits | `Runs | `Closed _ -> ()

(* What runs in the end, and whose it is. *)
type ending = { running : string option; named : string list; failures : string list }

(* Replies are for who has asked; all else is for everybody. *)
let say ~now consoles messages =
  let send i message c =
    match (message : Message.t) with
    | Plan_control r when r.request_id / 1000 <> c.first_request / 1000 -> ()
    | _ -> Network.send ~now (1000. +. now +. (1e-5 *. float_of_int i), message) c.back
  in
  List.iteri (fun i message -> List.iter (send i message) consoles) messages

(* The first console's plans are 't1' and 't2'; the second's is [plan], [offset] seconds after 't1' may have ended. *)
let play ?(plan = "intruder") ~seed ~loss ~delay offset =
  let random = Random.State.make [| seed |] in
  let quality = { Network.loss; duplication = 0.; delay } in
  let first = console ~random ~quality ~first_request:1000 ~waits:1. [ "t1"; "t2" ] in
  let second = console ~random ~quality ~first_request:5000 ~waits:(2. +. offset) [ plan ] in
  let consoles = [ first; second ] in
  (* The second console's 't2', if it is the first, fails at once. *)
  let fails = ref (plan = "t2") in
  let fate : string -> Vehicle_model.fate = function
    | "t1" -> Succeeds 1.
    | "t2" when !fails -> fails := false; Fails 0.05
    | _ -> Succeeds 30.
  in
  let before = { Message.Plan_control_state.default with state = Ready; plan_progress = -1. } in
  let vehicle = Vehicle_model.create ~fate ~before in
  let is_closed c = match c.phase with `Closed _ -> true | `Waits | `Runs | `Closes _ -> false in
  let rec go now closed_at =
    let requests = List.concat_map (fun c -> Network.arrived ~now c.out) consoles in
    let answers = List.concat_map (fun (_, r) -> Vehicle_model.request ~now ~copy:1 r vehicle) requests in
    say ~now consoles (answers @ Vehicle_model.tick ~now vehicle);
    List.iter (live ~now) consoles;
    let all_closed = List.for_all is_closed consoles in
    let closed_at = if all_closed then Float.min now closed_at else infinity in
    (* What was on its way has arrived. *)
    if now < closed_at +. 2. && now < 120. then go (now +. instant) closed_at
  in
  go 0. infinity;
  let state = Vehicle_model.state vehicle in
  { running = (if state.state = Executing then Some state.plan_id else None);
    named = List.filter_map (fun c -> match c.phase with `Closed named -> named | _ -> Some "(not closed)") consoles;
    failures = List.filter_map (fun c -> c.failure) consoles }

(* A plan that runs in the end was said to; and a console whose plan was taken away has said so. *)
let check ?plan ~loss ~delay seeds =
  let tried = ref 0 and both = ref 0 in
  let one seed offset =
    let ending = play ?plan ~seed ~loss ~delay offset in
    incr tried;
    if List.length ending.failures = 2 then incr both;
    match ending.running with
    | Some plan when not (List.mem plan ending.named) ->
      Alcotest.failf "seed %d, offset %g: nobody said that plan %s may still run (%s)" seed offset plan
        (String.concat "; " ending.failures)
    | Some _ | None -> ()
  in
  let offsets = List.init 13 (fun i -> -0.3 +. (0.05 *. float_of_int i)) in
  List.iter (fun seed -> List.iter (one seed) offsets) seeds;
  Printf.printf "%d runs, %d in which both consoles failed\n" !tried !both

let case ?plan name ~loss ~delay count =
  Alcotest.test_case name `Quick (fun () -> check ?plan ~loss ~delay (List.init count Fun.id))

let tests =
  ( "two consoles",
    [ case "requests and answers in every order" ~loss:0. ~delay:0.6 60;
      case "on a quick network" ~loss:0. ~delay:0.1 20;
      case "on a slow network, so that requests are sent again" ~loss:0. ~delay:0.65 60;
      case "both start the same plan" ~plan:"t2" ~loss:0. ~delay:0.6 60;
      case "on a network that loses datagrams" ~loss:0.3 ~delay:0.6 60 ] )
