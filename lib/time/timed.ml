open Dolphin_semantics
open Dolphin_environment

type options = {
  environment : Environment.options;
  program : Core.program;
  world : World.t;
  durations : Durations.t;
  dates : (int list, Core.site) result;
}

type item =
  | Task of Core.vehicle
  | Timer of Residual.timer
  | Question of Residual.timer
  | Recruit of Residual.timer
  | Answer
  | Reply
  | Posting of string
  | Coming of { vehicle : Core.vehicle; always : bool }
  | Course of Core.vehicle
  | Date of int

type pending = { item : item; bounds : Bounds.t; task : Core.platform_task option; prompt : string option }

type state = {
  configuration : Configuration.t;
  outside : Environment.t;
  pending : pending list;
  elsewhere : (Core.vehicle * Dolphin_geo.Position.t option) list;
  patience : (Core.vehicle option * Bounds.t) list;
  date : int;  (* that code has reached: what is pending says it, too *)
}

(* {1 States} *)

let compare_pending a b = Stdlib.compare (a.item, a.bounds) (b.item, b.bounds)

let compare a b =
  let both first second = if first <> 0 then first else second () in
  both (List.compare compare_pending a.pending b.pending) (fun () ->
      both (Environment.compare a.outside b.outside) (fun () ->
          both (Stdlib.compare (a.elsewhere, a.patience) (b.elsewhere, b.patience)) (fun () ->
              Configuration.compare a.configuration b.configuration)))

let equal a b =
  List.compare_lengths a.pending b.pending = 0
  && List.for_all2 (fun p q -> compare_pending p q = 0) a.pending b.pending
  && Environment.compare a.outside b.outside = 0
  && Stdlib.compare (a.elsewhere, a.patience) (b.elsewhere, b.patience) = 0
  && Configuration.equal a.configuration b.configuration

let hash s = (Configuration.hash s.configuration * 31) + Environment.hash s.outside

(* {1 What is awaited} *)

(* Faster than comparing any values: searches ask this most. *)
let is_same (a : item) (b : item) =
  match a, b with
  | Task v, Task w -> String.equal v w
  | Timer m, Timer n | Question m, Question n | Recruit m, Recruit n -> Int.equal m n
  | Answer, Answer | Reply, Reply -> true
  | Posting k, Posting l -> String.equal k l
  | Coming { vehicle = v; _ }, Coming { vehicle = w; _ } -> String.equal v w
  | Course v, Course w -> String.equal v w
  | Date m, Date n -> Int.equal m n
  | (Task _ | Timer _ | Question _ | Recruit _ | Answer | Reply | Posting _ | Coming _ | Course _ | Date _), _ -> false

let of_awaited : Transition.awaited -> item = function
  | End_of v -> Task v
  | Expiry_of timer -> Timer timer
  | Answer_to (question, _) -> Question question
  | Recruit_for (number, _) -> Recruit number
  | Answer -> Answer
  | Reply -> Reply

let of_event : Transition.event -> item option = function
  | Vehicle_done v | Vehicle_failed (v, _) -> Some (Task v)
  | Timer_expired timer -> Some (Timer timer)
  | Confirmed (question, _) -> Some (Question question)
  | Recruited (number, _) -> Some (Recruit number)
  | Answered _ | Nobody_answers _ -> Some Answer
  | Replied _ | Host_failed _ -> Some Reply
  | Input (k, _) -> Some (Posting k)
  | Interruption -> None

let may_wait_for_recruits o =
  let { Environment.faults; _ } = o.environment in
  Faults.is_possible faults.join || Faults.is_possible faults.loss || o.program.reads_sensors

let place o elsewhere v =
  match List.assoc_opt v elsewhere with Some place -> place | None -> o.durations.place v

(* What begins with an effect. *)
let begun o elsewhere : Effect.t -> pending option =
  let some ?task ?prompt item bounds = Some { item; bounds; task; prompt } in
  let timer timer bounds = some (Timer timer) bounds in
  function
  | Start (v, p) -> some ~task:p (Task v) (o.durations.task v (place o elsewhere v) p)
  | Set_timer (i, seconds) -> timer i (Bounds.exactly seconds)
  | Look_for pick ->
    timer Residual.script_timer (Option.fold ~none:o.durations.announced ~some:Bounds.exactly pick.timeout)
  | Put_question (question, prompt) -> some ~prompt (Question question) Some_time
  | Ask prompt -> some ~prompt Answer Bounds.at_once
  | Call_host _ -> some Reply Bounds.at_once
  | Stop _ | Cancel_timer _ | Withdraw_question _ | Bind _ | Release _ | Set_connection_timeout _ | Say _ | End _ ->
    None

(* Pairs may be posted until the end. *)
let postings o (c : Configuration.t) outside =
  match c.control with
  | Ended _ -> []
  | Script _ | Waiting _ | Executing _ ->
    let key (k, _, _) = k in
    List.sort_uniq String.compare (List.map key (Environment.inputs o.environment o.program outside))

(* Who is there matters as long as the program may look for vehicles. *)
let still_coming (c : Configuration.t) before =
  let matters = function
    | Coming { always; _ } -> (
        match c.control with Ended _ -> false | Executing _ -> always | Script _ | Waiting _ -> true)
    | _ -> false
  in
  List.filter matters (List.map (fun p -> p.item) before)

(* {2 The date} *)

(* The next date that code names. *)
let next_date o (c : Configuration.t) date =
  match o.dates, c.control with
  | Ok (_ :: _ as dates), (Script _ | Waiting _ | Executing _) -> List.find_opt (fun k -> k > date) dates
  | (Ok [] | Error _), _ | _, Ended _ -> None

let awaited o c outside date ~before =
  List.map of_awaited (Transition.awaited c)
  @ List.map (fun k -> Posting k) (postings o c outside)
  @ Option.fold (next_date o c date) ~none:[] ~some:(fun k -> [ Date k ])
  @ still_coming c before

let in_order = List.sort_uniq Stdlib.compare

(* [before] is what is awaited before a transition that answers [over] and asks for [effects], which leads to [c]: what
   is awaited there, and of it what has begun with the transition. *)
let pending o elsewhere ~before ~over effects c outside date =
  let now = List.filter_map (begun o elsewhere) effects in
  let latest item = List.fold_left (fun found p -> if is_same p.item item then Some p else found) None now in
  let is_over item = match over with Some other -> is_same other item | None -> false in
  let find item =
    match latest item with
    | Some p -> (p, true)
    | None -> (
        match List.find_opt (fun p -> is_same p.item item && not (is_over item)) before with
        | Some p -> (p, false)
        | None ->
          let bounds : Bounds.t =
            match item with
            | Posting k -> o.durations.posted k
            | Date k -> Bounds.exactly (float_of_int (k - date))
            | Answer -> Bounds.at_once
            | _ -> Some_time
          in
          ({ item; bounds; task = None; prompt = None }, true))
  in
  List.split (List.map find (in_order (awaited o c outside date ~before)))

let fresh pending is_fresh =
  List.filter_map Fun.id (List.map2 (fun p fresh -> if fresh then Some p.item else None) pending is_fresh)

(* With [--faults join] vehicles that are late come at any time: see [comes_late]. *)
let knows_who_joins o = o.durations.joins <> [] && not (Faults.is_possible o.environment.faults.join)
let may_join_during_tasks o =
  knows_who_joins o && (o.program.recruits || Dolphin_explore.Later_picks.may_follow o.program)

let coming o =
  if knows_who_joins o then
    let always = may_join_during_tasks o in
    let pending (vehicle, bounds) = { item = Coming { vehicle; always }; bounds; task = None; prompt = None } in
    List.map pending o.durations.joins
  else []

let initial o =
  let configuration = Configuration.initial o.program and outside = Environment.initial in
  let pending, _ = pending o [] ~before:(coming o) ~over:None [] configuration outside 0 in
  { configuration; outside; pending; elsewhere = []; patience = []; date = 0 }

(* {1 Where vehicles are} *)

let moved elsewhere v place = List.sort Stdlib.compare ((v, place) :: List.remove_assoc v elsewhere)

let is_away before item =
  List.exists (fun p -> p.item = item && Option.bind p.task Durations.moves <> None) before

let elsewhere_after s (t : Transition.t) (event : Transition.event option) =
  let stop elsewhere : Effect.t -> _ = function
    | Stop v when is_away s.pending (Task v) -> moved elsewhere v None
    | _ -> elsewhere
  in
  let elsewhere =
    match event with
    | Some (Vehicle_done v) -> (
        match Option.bind (Vehicle_map.find_opt v s.configuration.shared.allocation) Durations.moves with
        | Some place -> moved s.elsewhere v place
        | None -> s.elsewhere)
    | Some (Vehicle_failed (v, _)) when is_away s.pending (Task v) -> moved s.elsewhere v None
    | Some _ | None -> s.elsewhere
  in
  List.fold_left stop elsewhere t.effects

(* {1 Silent links} *)

(* The latest word on a vehicle, or on all; of no matter where nothing is lost. *)
let patience_after o s (t : Transition.t) =
  let set patience : Effect.t -> _ = function
    | Set_connection_timeout (None, seconds) -> [ (None, Bounds.exactly seconds) ]
    | Set_connection_timeout (Some vs, seconds) ->
      let set patience v = (Some v, Bounds.exactly seconds) :: List.remove_assoc (Some v) patience in
      List.sort Stdlib.compare (List.fold_left set patience vs)
    | _ -> patience
  in
  if Faults.is_possible o.environment.faults.loss then List.fold_left set s.patience t.effects else []

let patience o s v =
  match List.assoc_opt (Some v) s.patience with
  | Some bounds -> bounds
  | None -> Option.value (List.assoc_opt None s.patience) ~default:o.durations.silence

(* {1 Steps} *)

type step = {
  transition : Transition.t;
  next : state;
  due : (item * Bounds.t) option;
  fresh : item list;
  urgent : bool;
}

(* A guard that holds if a sensor shows this or that may go on not to hold. *)
let may_wait (t : Transition.t) =
  t.assumed <> []
  && match t.rules with (Condition | Recruit | Allof_when | Oneof_when | Until_cut | Assure_cut) :: _ -> true
                      | _ -> false

let comes_late (t : Transition.t) = List.exists (function World.Late _ -> true | _ -> false) t.assumed

let bounds_of s item =
  match List.find_opt (fun p -> is_same p.item item) s.pending with Some p -> p.bounds | None -> Some_time

(* What comes within [bounds] if the link is heard of all the time, and else so much later. *)
let put_off (silence : Bounds.t) (bounds : Bounds.t) : Bounds.t =
  match bounds, silence with
  | Within { least; most }, Within n -> Within { least; most = most + n.most }
  | (Within _ | Some_time | Never), _ -> Some_time

(* When the task of [v] is done, has failed, or is given up because nothing is heard of [v]. The order to a vehicle that
   is lost waits for the link. *)
let ends_of o s v =
  let silence = patience o s v in
  let heard bounds = if List.mem v (Environment.lost s.outside) then put_off silence bounds else bounds in
  let done_ = heard (bounds_of s (Task v)) in
  let failed = Bounds.from_the_start done_ in
  let lost : Bounds.t =
    match put_off silence failed, silence with
    | Within { most; _ }, Within { least; _ } -> Within { least; most }
    | bounds, _ -> bounds
  in
  (done_, failed, lost)

(* Whoever is there is recruited at once, as if the program did it by itself. *)
let is_event o s (choice : Environment.choice) =
  match choice.on with
  | None -> false
  | Some (Recruited (_, v)) ->
    choice.transition.assumed <> [] || Environment.may_stay_away o.environment s.outside v
  | Some _ -> true

let due o s (choice : Environment.choice) =
  let is_pick = match s.configuration.control with Waiting (_, Pick _) -> true | _ -> false in
  let with_bounds change = Option.map (fun item -> (item, change (bounds_of s item))) in
  match choice.on with
  | Some (Vehicle_done v) -> let bounds, _, _ = ends_of o s v in Some (Task v, bounds)
  | Some (Vehicle_failed (v, why)) ->
    let _, failed, lost = ends_of o s v in
    Some (Task v, if why = Environment.loss then lost else failed)
  | Some (Recruited _) when not (is_event o s choice) -> None
  | Some event -> with_bounds Fun.id (of_event event)
  | None when is_pick && comes_late choice.transition ->
    with_bounds Bounds.from_the_start (Some (Timer Residual.script_timer))
  | None when is_pick && not (knows_who_joins o) -> Some (Timer Residual.script_timer, Bounds.at_once)
  | None -> None

let step o s (choice : Environment.choice) =
  let t = choice.transition in
  let over = Option.bind choice.on of_event in
  let elsewhere = elsewhere_after s t choice.on in
  let pending, is_fresh = pending o elsewhere ~before:s.pending ~over t.effects t.next choice.outside s.date in
  { transition = t; due = due o s choice;
    urgent = (not (is_event o s choice)) && (not (may_wait t)) && not (comes_late t);
    fresh = fresh pending is_fresh;
    next =
      { configuration = t.next; outside = choice.outside; pending; elsewhere; patience = patience_after o s t;
        date = s.date } }

let taken o s ~on transition = step o s { transition; outside = s.outside; on }

(* What never happens is no step, and what may happen at once bounds nothing. *)
let is_possible step = match step.due with Some (_, Never) -> false | Some (_, (Within _ | Some_time)) | None -> true

let starts_without_moving step =
  match step.transition.effects with [ Start (_, p) ] -> Durations.moves p = None | _ -> false

(* {2 Who is there} *)

let coming_of v p = match p.item with Coming { vehicle; _ } -> String.equal vehicle v | _ -> false
let is_away s v = List.exists (coming_of v) s.pending

(* In the order in which they are heard of. *)
let late_ones o = if knows_who_joins o then List.map fst o.durations.joins else []

(* What is to be assumed of the whole fleet in [s]. *)
let attendance o s =
  let away, come = List.partition (is_away s) (late_ones o) in
  List.map (fun v -> World.Late v) come @ List.map (fun v -> World.Missing v) away

(* The next vehicle is heard of. *)
let arrival o s =
  let of_pending p =
    let transition : Transition.t =
      { rules = []; label = Silent; next = s.configuration; effects = []; assumed = [] } in
    { transition; due = Some (p.item, p.bounds); urgent = false; fresh = [];
      next = { s with pending = List.filter (fun q -> q != p) s.pending } }
  in
  match List.find_opt (is_away s) (late_ones o) with
  | Some v -> Option.map of_pending (List.find_opt (coming_of v) s.pending)
  | None -> None

let is_of_date step = match step.due with Some (Date _, _) -> true | Some _ | None -> false
let is_arrival step = match step.due with Some (Coming _, _) -> true | Some _ | None -> false

(* It matters where vehicles are looked for. *)
let in_whole_fleet o s step =
  let t = step.transition in
  let looks =
    match s.configuration.control, t.label with
    | Waiting (_, Pick _), _ | _, Recruit _ -> true
    | (Script _ | Waiting _ | Executing _ | Ended _), _ -> false
  in
  if is_arrival step || is_of_date step then None
  else if looks then Some { t with assumed = attendance o s @ t.assumed }
  else Some t

let transitions o s steps =
  let add (s, found) step = (step.next, in_whole_fleet o s step :: found) in
  List.rev (snd (List.fold_left add (s, []) steps))

(* {2 The date} *)

(* No transition: only what code reads of the date changes. *)
let date_step o s =
  let reached k =
    let c = s.configuration in
    let transition : Transition.t = { rules = []; label = Silent; next = c; effects = []; assumed = [] } in
    let pending, is_fresh =
      pending o s.elsewhere ~before:s.pending ~over:(Some (Date k)) [] c s.outside k in
    { transition; due = Some (Date k, bounds_of s (Date k)); fresh = fresh pending is_fresh; urgent = false;
      next = { s with pending; date = k } }
  in
  Option.map reached (next_date o s.configuration s.date)

let world o s =
  let world = World.suppose (attendance o s) o.world in
  if o.program.reads_now then World.at (Since s.date) world else world

let all_steps o s =
  let with_step (choice : Environment.choice) = (choice, step o s choice) in
  let choices =
    Environment.choices_on o.environment o.program (world o s) s.outside s.configuration
    |> Seq.map with_step |> Seq.filter (fun (_, step) -> is_possible step) |> List.of_seq
  in
  let all = List.map snd choices @ Option.to_list (date_step o s) in
  if not (List.exists (fun step -> step.urgent) all) then
    all @ List.filter is_possible (Option.to_list (arrival o s))
  else if List.exists (fun step -> comes_late step.transition) all then
    List.map (fun step -> { step with urgent = false }) all
  else
    let own (choice, step) = if is_event o s choice then None else Some step in
    List.filter_map own choices

let steps o s =
  let steps = all_steps o s in
  let comes_first step = step.urgent && starts_without_moving step && not o.program.asks_running in
  match List.find_opt comes_first steps with
  | Some start -> [ start ]
  | None -> steps

let holds_up steps =
  let most : Bounds.t -> int = function Within { most; _ } -> most | Some_time | Never -> max_int in
  let bound found step =
    match step.due with
    | Some (item, bounds) ->
      let before = Option.value (List.assoc_opt item found) ~default:0 in
      (item, max before (most bounds)) :: List.remove_assoc item found
    | None -> found
  in
  List.filter (fun (_, most) -> most < max_int) (List.fold_left bound [] steps)

let is_stuck o s steps =
  let c = s.configuration in
  let is_over = match c.control with Ended _ -> true | Script _ | Waiting _ | Executing _ -> false in
  let waits = Environment.only_recruits o.environment s.outside (List.map (fun step -> step.transition) steps) in
  (not is_over) && waits && not (Environment.owes o.environment o.program s.outside)
