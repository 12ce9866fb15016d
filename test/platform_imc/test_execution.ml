open Dolphin_imc
open Dolphin_platform_imc

(* {1 A console, a network, a vehicle} *)

type order = { plan : string; stop_after : float option  (** s; if the plan is not over by then *) }

type script = {
  seed : int;
  outward : Network.quality;
  inward : Network.quality;
  before : Message.Plan_control_state.t;
  fates : (string * Vehicle_model.fate) list;
  orders : order list;
  clock : float * float;  (** what the vehicle's clock shows at 0, and its rate *)
}

type verdict = Done | Failed of string | Stopped | Nothing

type log = {
  script_order : order;
  verdict : verdict;
  executions : Vehicle_model.execution list;  (** of this order, latest first *)
  meanwhile : Vehicle_model.execution list;
  (** of any order, late copies being among them: one may have begun just before this order *)
  notes : string list;
}

type world = {
  mutable now : float;
  mutable execution : Execution.t;
  mutable clock : Vehicle_clock.t;
  mutable verdicts : verdict list;
  mutable notes : string list;
  mutable told : string list;  (* all notes *)
  mutable aborts : int;
  mutable escaped : float;  (* how long the vehicle moved while nothing was ordered, at most, in a row *)
  mutable at_large : float;  (* how long it has, now *)
  mutable copies : (int * int) list;  (* of each request for this order, how many were sent *)
  sleeps : float -> bool;  (* whether the vehicle has no processor then: it reads and sends nothing *)
  mutable slept : bool;  (* whether it has just had none *)
  vehicle : Vehicle_model.t;
  out : (int * Message.t Message.Plan_control.t) Network.t;
  back : (float * Message.t) Network.t;
}

let instant = 0.01

let carry_out w : Execution.output -> unit = function
  | Done -> w.verdicts <- Done :: w.verdicts
  | Failed why -> w.verdicts <- Failed why :: w.verdicts
  | Remark text ->
    w.notes <- text :: w.notes;
    w.told <- text :: w.told
  | Send (Plan_control c) ->
    let sent = 1 + Option.value (List.assoc_opt c.request_id w.copies) ~default:0 in
    w.copies <- (c.request_id, sent) :: List.remove_assoc c.request_id w.copies;
    Network.send ~now:w.now (sent, c) w.out
  | Keep _ -> ()
  | Send Abort ->
    w.aborts <- w.aborts + 1;
    let stamp i = w.now +. (1e-5 *. float_of_int i) in
    List.iteri (fun i m -> Network.send ~now:w.now (stamp i, m) w.back) (Vehicle_model.abort w.vehicle)
  | Send _ -> failwith "sent something else"

let input w i =
  let execution, outputs = Execution.step ~now:w.now ~clock:w.clock i w.execution in
  w.execution <- execution;
  List.iter (carry_out w) outputs

let hear w (stamp, (message : Message.t)) =
  let clock, sent = Vehicle_clock.observe ~now:w.now ~sent:stamp w.clock in
  w.clock <- clock;
  match message with
  | Plan_control reply -> input w (Reply { sent; reply })
  | Plan_control_state state -> input w (State { sent; state })
  | Vehicle_state state -> input w (Vehicle { sent; state })
  | Log_book_entry entry -> input w (Log { sent; entry })
  | _ -> ()

(* Messages of one instant get stamps of their own, as they do on a real vehicle. *)
let say (s : script) w messages =
  let origin, rate = s.clock in
  let stamp i = origin +. (rate *. (w.now +. (1e-5 *. float_of_int i))) in
  List.iteri (fun i m -> Network.send ~now:w.now (stamp i, m) w.back) messages

let advance (s : script) w =
  w.now <- w.now +. instant;
  let sleeps = w.sleeps w.now in
  (* Once it has its processor again, it sends its reports before it reads what came. *)
  let requests = if sleeps || w.slept then [] else Network.arrived ~now:w.now w.out in
  let answered =
    List.concat_map (fun (copy, c) -> Vehicle_model.request ~now:w.now ~copy c w.vehicle) requests in
  w.slept <- sleeps;
  say s w (answered @ if sleeps then [] else Vehicle_model.tick ~now:w.now w.vehicle);
  List.iter (hear w) (Network.arrived ~now:w.now w.back);
  if Execution.due w.execution <= w.now then input w Tick;
  let is_at_large = Vehicle_model.maneuvers w.vehicle && Execution.idle w.execution in
  w.at_large <- (if is_at_large then w.at_large +. instant else 0.);
  w.escaped <- Float.max w.escaped w.at_large

let patience = 120.

let run_order (s : script) w (o : order) =
  let began = w.now in
  let is_running = (Vehicle_model.state w.vehicle).state = Executing in
  let ended_before = List.length (Vehicle_model.executions w.vehicle) - if is_running then 1 else 0 in
  w.verdicts <- [];
  w.notes <- [];
  w.copies <- [];
  input w (Start { plan = o.plan; specification = None });
  let rec wait () =
    if w.verdicts <> [] then List.hd w.verdicts
    else
      match o.stop_after with
      | Some seconds when w.now >= began +. seconds -> input w Stop; Stopped
      | Some _ | None -> if w.now > began +. patience then Nothing else (advance s w; wait ())
  in
  let verdict = wait () in
  let of_order (e : Vehicle_model.execution) = List.mem_assoc e.request w.copies in
  let all = Vehicle_model.executions w.vehicle in
  { script_order = o; verdict;
    executions = List.filter of_order all;
    meanwhile = List.filteri (fun i _ -> i < List.length all - ended_before) all;
    notes = w.notes }

let world ?abort_after ?(sleeps = fun _ -> false) (s : script) =
  let random = Random.State.make [| s.seed |] in
  let fate plan = List.assoc plan s.fates in
  { now = 0.; execution = Execution.create ?abort_after ~request:65530 ();
    clock = Vehicle_clock.unknown; verdicts = []; notes = []; told = [];
    aborts = 0; escaped = 0.; at_large = 0.;
    copies = []; sleeps; slept = false;
    vehicle = Vehicle_model.create ~fate ~before:s.before; out = Network.create random s.outward;
    back = Network.create random s.inward }

let pass (s : script) w seconds =
  let until = w.now +. seconds in
  while w.now < until do advance s w done

(* The orders one after another, and then some quiet time. *)
let play ?abort_after ?sleeps (s : script) =
  let w = world ?abort_after ?sleeps s in
  pass s w 2.;
  let logs = List.map (run_order s w) s.orders in
  pass s w 15.;
  (logs, w)

(* {1 Scripts} *)

let generate ~outward ~inward ~fates =
  let open QCheck2.Gen in
  let plan = oneofl [ "a"; "b"; "c" ] in
  let fate =
    oneof
      ([ map (fun t -> Vehicle_model.Succeeds t) (float_range 0.05 6.) ]
       @ if fates then
         [ map (fun t -> Vehicle_model.Fails t) (float_range 0.05 4.);
           return (Vehicle_model.Is_refused "undefined plan") ]
       else [])
  in
  let before =
    let state s plan_id last_outcome =
      { Message.Plan_control_state.default with state = s; plan_id; last_outcome; plan_progress = -1. }
    in
    oneofl
      [ state Ready "" None; state Ready "a" Success; state Ready "a" Failure; state Executing "a" None;
        state Executing "x" Success ]
  in
  let order =
    let* plan = plan and* stop = frequency [ (3, return None); (1, map Option.some (float_range 0. 3.)) ] in
    return { plan; stop_after = stop }
  in
  let* seed = int_bound 1_000_000
  and* outward = outward
  and* inward = inward
  and* before = before
  and* a = fate and* b = fate and* c = fate
  and* orders = list_size (int_range 1 4) order
  and* origin = oneofl [ 0.; 1.79e9; -1e6 ]
  and* rate = oneofl [ 1.; 1.; 1.001; 5. ] in
  return
    { seed; outward; inward; before; fates = [ ("a", a); ("b", b); ("c", c) ]; orders; clock = (origin, rate) }

let print (s : script) =
  let quality (q : Network.quality) = Printf.sprintf "loss %.2f, twice %.2f, delay %.2f" q.loss q.duplication q.delay in
  let fate : Vehicle_model.fate -> string = function
    | Succeeds t -> Printf.sprintf "succeeds after %.2f" t
    | Fails t -> Printf.sprintf "fails after %.2f" t
    | Is_refused why -> "refused: " ^ why
    | Is_lost (t, lasts) -> Printf.sprintf "is lost after %.2f for %.2f" t lasts
  in
  let order o =
    match o.stop_after with None -> o.plan | Some t -> Printf.sprintf "%s, stopped after %.2f" o.plan t
  in
  String.concat "\n"
    ([ Printf.sprintf "seed %d, out: %s; in: %s" s.seed (quality s.outward) (quality s.inward);
       Printf.sprintf "before: %s %s %s" (Message.Plan_control_state.State.name s.before.state) s.before.plan_id
         (Message.Plan_control_state.Last_outcome.name s.before.last_outcome);
       Printf.sprintf "clock from %g at rate %g" (fst s.clock) (snd s.clock) ]
     @ List.map (fun (p, f) -> p ^ " " ^ fate f) s.fates
     @ List.map order s.orders)

let quality ~loss ~duplication ~delay:longest =
  let open QCheck2.Gen in
  let* loss = float_range 0. loss
  and* duplication = float_range 0. duplication
  and* delay = float_range 0. longest in
  return { Network.loss; duplication; delay }

let perfect = QCheck2.Gen.return { Network.loss = 0.; duplication = 0.; delay = 0. }
let reordering = quality ~loss:0. ~duplication:0. ~delay:0.3
let doubling = quality ~loss:0. ~duplication:0.5 ~delay:0.3
let losing = quality ~loss:0.3 ~duplication:0. ~delay:0.3
let bad = quality ~loss:0.3 ~duplication:0.1 ~delay:0.3

(* {1 Properties} *)

let complain fmt = Printf.ksprintf (fun text -> QCheck2.Test.fail_report text) fmt

(* A plan is done only if it ran to its end for this order. Where requests are delayed, that of an order that was
   stopped may come after the next one, for the same plan: its run counts then, and [executions] has it, for vehicles
   do not say which request they carry out. *)
let is_sound ?executions (l : log) =
  let executions = Option.value executions ~default:l.executions in
  match l.verdict with
  | Done ->
    List.exists (fun (e : Vehicle_model.execution) -> e.succeeded && e.plan = l.script_order.plan) executions
    || complain "%s is not done" l.script_order.plan
  | Failed _ | Stopped | Nothing -> true

let is_sound_meanwhile (l : log) = is_sound ~executions:l.meanwhile l
let is_complete (l : log) = l.verdict <> Nothing || complain "no verdict on %s" l.script_order.plan

let verdict_is_fate (s : script) (l : log) =
  match l.verdict, List.assoc l.script_order.plan s.fates with
  | Done, Succeeds _ | Stopped, _ -> true
  | Failed why, Fails _ -> why = "depth beyond limits" || complain "failed: %s" why
  | Failed why, Is_refused words -> why = words || complain "refused: %s" why
  | Failed why, Succeeds _ -> complain "%s failed: %s" l.script_order.plan why
  | Failed why, Is_lost _ -> why = "the vehicle is blocked: it cannot run plans now" || complain "lost: %s" why
  | (Done | Nothing), _ -> complain "another verdict"

let different_copies (l : log) =
  List.sort_uniq compare (List.map (fun (e : Vehicle_model.execution) -> (e.request, e.copy)) l.executions)

let ran_once_or_says_so (l : log) =
  List.length (different_copies l) <= 1 || l.notes <> [] || complain "%s ran several times" l.script_order.plan

(* Copies that the network makes count here. The words may come when the order is over. *)
let each_anew_is_told logs (w : world) =
  let anew = List.filter (fun (l : log) -> List.length l.executions > 1) logs in
  List.length anew <= List.length w.told
  || complain "%d begun anew, notes: %s" (List.length anew) (String.concat "; " w.told)

(* No request whose copy had arrived was sent again. *)
let never_resent_in_vain (l : log) =
  let requests = List.map fst (different_copies l) in
  List.length (List.sort_uniq compare requests) = List.length requests
  || complain "a copy of %s was sent in vain" l.script_order.plan

let is_over (w : world) =
  let ordered = Execution.idle w.execution in
  let ours = Vehicle_model.executions w.vehicle <> [] in
  (ordered || complain "something is still ordered")
  && ((not ours) || (Vehicle_model.state w.vehicle).state <> Executing || complain "something runs on")

(* DOLPHIN_LONG multiplies the counts. *)
let longer = match Sys.getenv_opt "DOLPHIN_LONG" with Some n -> int_of_string n | None -> 1

let property name ?(count = 300) ~outward ~inward ?(fates = true) check =
  Test_support.Property.case ~count:(count * longer) name ~print (generate ~outward ~inward ~fates) (fun s ->
      let logs, w = play s in
      check s logs w)

(* {1 Plans that get lost} *)

let any_script = generate ~outward:reordering ~inward:reordering ~fates:true

let lossy_script =
  let open QCheck2.Gen in
  let* s = any_script in
  let* after = float_range 0.5 5. and* lasts = oneof [ float_range 0.5 30.; float_range 60. 90. ] in
  return { s with fates = ("a", Vehicle_model.Is_lost (after, lasts)) :: List.remove_assoc "a" s.fates; clock = (0., 1.) }

(* A second of rest is allowed to VehicleState, and what a datagram takes. *)
let is_never_at_large (w : world) = w.escaped <= 2. || complain "it moved for %.2f s while nothing was ordered" w.escaped

let lost_plan name ?abort_after check =
  Test_support.Property.case ~count:(300 * longer) name ~print lossy_script (fun s ->
      let logs, w = play ?abort_after s in
      is_never_at_large w && check s logs w)

(* {1 Vehicles without a processor for a while} *)

let naps =
  let open QCheck2.Gen in
  let nap at =
    let+ later = float_range 0. 4. and+ longer = float_range 0. 3.5 in
    (at +. later, at +. later +. 0.5 +. longer)
  in
  flatten_l (List.init 20 (fun i -> nap (2. +. (8. *. float_of_int i))))

let napping check =
  let prompt = quality ~loss:0. ~duplication:0. ~delay:0.05 in
  let print (s, naps) =
    print s ^ String.concat "" (List.map (fun (a, b) -> Printf.sprintf "\nsleeps from %.2f to %.2f" a b) naps) in
  Test_support.Property.case ~count:(1000 * longer) ~print "a vehicle that wakes up reads a request late: each plan once"
    (QCheck2.Gen.pair (generate ~outward:prompt ~inward:prompt ~fates:true) naps)
    (fun (s, naps) ->
       let sleeps now = List.exists (fun (a, b) -> a <= now && now < b) naps in
       let s = { s with clock = (fst s.clock, 1.) } in
       let logs, w = play ~sleeps s in
       check s logs w)

let each_copy_is_told =
  Alcotest.test_case "three copies of a request" `Quick (fun () ->
      let perfect = { Network.loss = 0.; duplication = 0.; delay = 0. } in
      let before = { Message.Plan_control_state.default with state = Ready; plan_progress = -1. } in
      let s =
        { seed = 1; outward = perfect; inward = perfect; before; fates = [ ("a", Succeeds 9.) ]; orders = [];
          clock = (0., 1.) }
      in
      let w = world s in
      pass s w 2.;
      input w (Start { plan = "a"; specification = None });
      w.now <- w.now +. instant;
      let requests = Network.arrived ~now:w.now w.out in
      Alcotest.(check int) "requests" 1 (List.length requests);
      let take told =
        List.iter (fun (copy, r) -> say s w (Vehicle_model.request ~now:w.now ~copy r w.vehicle)) requests;
        pass s w 0.1;
        Alcotest.(check int) "told" told (List.length w.told)
      in
      List.iter take [ 0; 1; 2 ])

(* The vehicle runs another's plan of that name, which no report told before the request, and the request is lost. *)
let another's_plan_is_not_ours =
  Alcotest.test_case "another's plan of the same name, a lost request" `Quick (fun () ->
      let perfect = { Network.loss = 0.; duplication = 0.; delay = 0. } in
      let before =
        { Message.Plan_control_state.default with state = Executing; plan_id = "a"; plan_progress = -1. } in
      let s =
        { seed = 1; outward = perfect; inward = perfect; before; fates = [ ("a", Succeeds 0.1) ]; orders = [];
          clock = (0., 1.) }
      in
      let w = world s in
      input w (Start { plan = "a"; specification = None });
      w.now <- w.now +. instant;
      Alcotest.(check int) "lost" 1 (List.length (Network.arrived ~now:w.now w.out));
      pass s w 5.;
      Alcotest.(check bool) "done" true (w.verdicts = [ Done ]);
      let is_ours (e : Vehicle_model.execution) = e.request = 65530 in
      Alcotest.(check int) "of our request" 1
        (List.length (List.filter is_ours (Vehicle_model.executions w.vehicle))))

let tests =
  ( "execution",
    [ each_copy_is_told; another's_plan_is_not_ours;
      lost_plan "a plan engine loses its plan: the vehicle is not idle while it maneuvers" (fun _ _ w ->
          w.aborts = 0 || complain "it was aborted");
      lost_plan "a plan engine loses its plan: the vehicle is aborted if that is wanted" ~abort_after:3. (fun _ _ w ->
          (not (Vehicle_model.maneuvers w.vehicle)) || complain "it goes on");
      property "a perfect network: the vehicle's own verdict, each plan once" ~outward:perfect ~inward:perfect
        (fun s logs w ->
           List.for_all (fun l -> verdict_is_fate s l && is_sound l && ran_once_or_says_so l && l.notes = []) logs
           && is_over w);
      property "reordering: the same" ~outward:reordering ~inward:reordering (fun s logs w ->
          List.for_all (fun l -> verdict_is_fate s l && is_sound_meanwhile l && never_resent_in_vain l) logs
          && List.for_all ran_once_or_says_so logs && is_over w);
      property "requests get lost: each plan once" ~outward:losing ~inward:reordering (fun s logs w ->
          List.for_all (fun l -> verdict_is_fate s l && is_sound_meanwhile l && never_resent_in_vain l) logs
          && List.for_all ran_once_or_says_so logs && is_over w);
      (* A vehicle that wakes up may report that it rests before it reads the start and the stop of a plan: then the
         words on the next plan may be missed. *)
      napping (fun s logs w ->
          let none_is_stopped = List.for_all (fun o -> o.stop_after = None) s.orders in
          List.for_all (fun l -> is_complete l && is_sound_meanwhile l && never_resent_in_vain l) logs
          && ((not none_is_stopped) || List.for_all (verdict_is_fate s) logs)
          && List.for_all ran_once_or_says_so logs && is_over w);
      property "requests are doubled: no plan begins anew without a word" ~count:10_000 ~outward:doubling ~inward:perfect
        (fun _ logs w -> List.for_all is_complete logs && each_anew_is_told logs w && is_over w);
      property "what the vehicle says gets lost: no plan twice without a word" ~count:1000 ~outward:losing
        ~inward:losing
        (fun _ logs w ->
           List.for_all (fun l -> is_sound l && is_complete l && ran_once_or_says_so l) logs && is_over w);
      property "loss, duplication and reordering both ways" ~count:1000 ~outward:bad ~inward:bad (fun _ logs w ->
          List.for_all (fun l -> is_sound_meanwhile l && is_complete l) logs && is_over w) ] )
