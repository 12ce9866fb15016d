open Dolphin_semantics
open Dolphin_environment

type options = {
  environment : Environment.options;
  program : Core.program;
  world : World.t;
  durations : Durations.t;
  dates : (Dated_code.dates, Core.site) result;
}

type item =
  | Task of Core.vehicle
  | Timer of Residual.timer
  | Question of Residual.timer
  | Recruit of Residual.timer
  | Answer
  | Reply
  | Posting of string
  | Links
  | Silence of Core.vehicle
  | Course of Core.vehicle
  | Date of int

type progress = Under_way | Ordered | Over

type pending = {
  item : item;
  bounds : Bounds.t;
  task : Core.platform_task option;
  prompt : string option;
  progress : progress;
}

type state = {
  configuration : Configuration.t;
  outside : Environment.t;
  pending : pending list;
  elsewhere : (Core.vehicle * Whereabouts.t option) list;
  patience : (Core.vehicle option * Bounds.t) list;
  date : int;  (* reached by code; included in the pending events *)
  changes : int;  (* of links before this one are over, or do not matter *)
  settled : bool;  (* the program looks for no vehicles any more *)
}

(* {1 States} *)

let site s item =
  match item, s.configuration.control with
  | Timer 0, (Script _ | Waiting _) -> Some (Configuration.site s.configuration)
  | Timer n, Executing (_, r) -> Residual.site_of_timer n r
  | _, _ -> None

let compare_pending a b = Stdlib.compare (a.item, a.bounds, a.progress) (b.item, b.bounds, b.progress)
let rest s = (s.elsewhere, s.patience, s.changes, s.settled)

let compare a b =
  let both first second = if first <> 0 then first else second () in
  both (List.compare compare_pending a.pending b.pending) (fun () ->
      both (Environment.compare a.outside b.outside) (fun () ->
          both (Stdlib.compare (rest a) (rest b)) (fun () ->
              Configuration.compare a.configuration b.configuration)))

let equal a b =
  List.compare_lengths a.pending b.pending = 0
  && List.for_all2 (fun p q -> compare_pending p q = 0) a.pending b.pending
  && Environment.compare a.outside b.outside = 0
  && Stdlib.compare (rest a) (rest b) = 0
  && Configuration.equal a.configuration b.configuration

let hash s = (Configuration.hash s.configuration * 31) + Environment.hash s.outside

module Table = Hashtbl.Make (struct
    type t = state

    let equal = equal
    let hash = hash
  end)

(* {1 What is awaited} *)

(* Faster than comparing any values: searches ask this most. *)
let is_same (a : item) (b : item) =
  match a, b with
  | Task v, Task w -> String.equal v w
  | Timer m, Timer n | Question m, Question n | Recruit m, Recruit n -> Int.equal m n
  | Answer, Answer | Reply, Reply -> true
  | Posting k, Posting l -> String.equal k l
  | Silence v, Silence w | Course v, Course w -> String.equal v w
  | Links, Links -> true
  | Date m, Date n -> Int.equal m n
  | (Task _ | Timer _ | Question _ | Recruit _ | Answer | Reply | Posting _ | Links | Silence _ | Course _ | Date _), _
    -> false

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

(* {2 Links} *)

(* With [--faults join] vehicles that are late come at any time: see [comes_late]. With [--faults loss] links are lost
   at any time, too. *)
let links o = Durations.links_with o.environment.faults o.durations
let has_links o = Links.count (links o) > 0 || Links.late (links o) <> []

let may_join_during_tasks o =
  has_links o && (o.program.recruits || Dolphin_explore.Later_picks.may_follow o.program)

let may_change_during_tasks o =
  may_join_during_tasks o || Links.count (links o) > Links.count (Links.only_first (links o))

let without_pairs keys s =
  let c = s.configuration in
  let is_there key = Tuples.poll_any key c.shared.tuples in
  if List.exists is_there keys then
    { s with configuration = { c with shared = Shared.without_keys keys c.shared } }
  else s

let is_silent o s v = Links.is_silent (links o) s.changes v

let at_rest o v : Dolphin_scenario.Battery.doing list =
  if o.durations.has_chargers v then [ Away; Rests ] else [ Rests ]

let doing o s v : Dolphin_scenario.Battery.doing =
  match List.find_opt (fun p -> p.item = Task v && p.progress = Under_way) s.pending with
  | None -> List.hd (at_rest o v)
  | Some { task; _ } ->
    let charges = Option.bind task (fun (p : Core.platform_task) -> o.durations.charges p.name) in
    Option.fold charges ~none:Dolphin_scenario.Battery.Works ~some:(fun share -> Dolphin_scenario.Battery.Charges share)


let may_do o s v : Dolphin_scenario.Battery.doing list =
  match doing o s v with
  | Charges _ as charges when Faults.is_possible o.environment.faults.loss || is_silent o s v -> charges :: at_rest o v
  | Rests | Away -> at_rest o v
  | (Works | Charges _) as doing -> [ doing ]

(* The presence of a vehicle matters as long as the program may look for vehicles, and a silent link as long as it
   has the vehicle. *)
let with_changes_that_matter o s =
  let links = links o in
  if s.changes = Links.count links then s
  else
    match s.configuration.control with
    | Ended _ -> { s with changes = Links.count links }
    | Script _ | Waiting _ | Executing _ as control ->
      let executes = match control with Executing _ -> true | _ -> false in
      let settled = s.settled || (executes && not (may_join_during_tasks o)) in
      let matters v = (not settled) || List.mem v s.configuration.shared.bound in
      { s with settled; changes = Links.next links s.changes ~matters }

let patience o s v =
  match List.assoc_opt (Some v) s.patience with
  | Some bounds -> bounds
  | None -> Option.value (List.assoc_opt None s.patience) ~default:o.durations.silence

(* {2 By themselves, and with effects} *)

let no_more item bounds = { item; bounds; task = None; prompt = None; progress = Under_way }

(* The events that begin with an effect that leads to [s]. *)
let begun o s : Effect.t -> pending list =
  let timer timer bounds = [ no_more (Timer timer) bounds ] in
  function
  | Start (v, p) ->
    let bounds = o.durations.task v (place o s.elsewhere v) p in
    let task progress = { (no_more (Task v) bounds) with task = Some p; progress } in
    if is_silent o s v then [ task Ordered; no_more (Silence v) (patience o s v) ] else [ task Under_way ]
  | Set_timer (i, seconds) -> timer i (Bounds.exactly seconds)
  | Look_for pick ->
    timer Residual.script_timer (Option.fold ~none:o.durations.announced ~some:Bounds.exactly pick.timeout)
  | Put_question (question, prompt) -> [ { (no_more (Question question) Some_time) with prompt = Some prompt } ]
  | Ask prompt -> [ { (no_more Answer Bounds.at_once) with prompt = Some prompt } ]
  | Call_host _ -> [ no_more Reply Bounds.at_once ]
  | Stop _ | Cancel_timer _ | Withdraw_question _ | Bind _ | Release _ | Set_connection_timeout _ | Say _ | End _ -> []

(* Pairs may be posted until the end. *)
let postings o (c : Configuration.t) outside =
  match c.control with
  | Ended _ -> []
  | Script _ | Waiting _ | Executing _ -> Environment.keys_of_inputs o.environment o.program outside

(* {2 The date} *)

(* The next date that code names. *)
let next_date o (c : Configuration.t) date =
  match o.dates, c.control with
  | Ok dates, (Script _ | Waiting _ | Executing _) -> Dated_code.following dates date
  | Error _, _ | _, Ended _ -> None

let repeated o k = match o.dates with Ok dates -> Dated_code.repeated dates k | Error _ -> k

(* The next change of a link that matters. *)
let change o s =
  let links = links o in
  if s.changes = Links.count links then None else Some (Links.change links s.changes)

let awaited o s =
  let c = s.configuration in
  let awaited = List.map of_awaited (Transition.awaited c) in
  let silence = function Task v when is_silent o s v -> Some (Silence v) | _ -> None in
  awaited @ List.filter_map silence awaited
  @ List.map (fun k -> Posting k) (postings o c s.outside)
  @ Option.fold (next_date o c s.date) ~none:[] ~some:(fun k -> [ Date k ])
  @ Option.fold (change o s) ~none:[] ~some:(fun _ -> [ Links ])

let in_order = List.sort_uniq Stdlib.compare

let by_itself o s item =
  let bounds : Bounds.t =
    match item with
    | Posting k -> o.durations.posted k
    | Date k -> Bounds.exactly (float_of_int (k - s.date))
    | Silence v -> patience o s v
    | Answer -> Bounds.at_once
    | Task _ | Timer _ | Question _ | Recruit _ | Reply | Links | Course _ -> Some_time
  in
  no_more item bounds

(* The clock of links runs from the start; the awaited change varies. *)
let until_change o s p =
  match change o s with
  | Some (_, ms) ->
    { p with bounds = Within { least = ms; most = ms }; prompt = Some (Links.words (links o) s.changes) }
  | None -> p

(* Of many items, inputs for example, each is looked up. *)
let by_item pending =
  if List.compare_length_with pending 16 <= 0 then fun item -> List.find_opt (fun p -> is_same p.item item) pending
  else begin
    let table = Hashtbl.create 64 in
    List.iter (fun p -> if not (Hashtbl.mem table p.item) then Hashtbl.add table p.item p) pending;
    Hashtbl.find_opt table
  end

(* [s] with its pending events, including those that begin with a transition that leads to [s], answers [over] and
   requests [effects]; [before] was pending before. *)
let with_pending o ~before ~over effects s =
  let s = with_changes_that_matter o s in
  let now = List.concat_map (begun o s) effects in
  let latest item = List.fold_left (fun found p -> if is_same p.item item then Some p else found) None now in
  let is_over item = match over with Some other -> is_same other item | None -> false in
  let pending = by_item before in
  let find item =
    match latest item with
    | Some p -> (p, true)
    | None -> (
        match if is_over item then None else pending item with
        | Some p -> (p, false)
        | None -> (by_itself o s item, true))
  in
  let known (p, fresh) = ((match p.item with Links -> until_change o s p | _ -> p), fresh) in
  let found = List.map (fun item -> known (find item)) (in_order (awaited o s)) in
  let fresh (p, is_fresh) = if is_fresh then Some p.item else None in
  ({ s with pending = List.map fst found }, List.filter_map fresh found)

let initial o =
  let configuration = Configuration.initial o.program and outside = Environment.initial in
  let s =
    { configuration; outside; pending = []; elsewhere = []; patience = []; date = 0; changes = 0; settled = false } in
  fst (with_pending o ~before:[] ~over:None [] s)

(* What is left of [p] after [passed] milliseconds. *)
let shortened passed p =
  let bounds : Bounds.t =
    match p.bounds, p.item with
    | Within { least; most }, _ when passed <= most ->
      Within { least = max 0 (least - passed); most = most - passed }
    | Within _, (Timer _ | Date _) -> Bounds.at_once
    | (Within _ | Some_time), _ -> Some_time
    | Never, _ -> Never
  in
  { p with bounds }

let onwards o s ~outside ~now ~began ~seen =
  let latest = match o.dates with Ok dates -> max s.date (Dated_code.latest dates (now / 1000)) | Error _ -> s.date in
  let date = repeated o latest in
  let before = List.filter (fun p -> match p.item with Date _ -> false | _ -> true) s.pending in
  let runs v = List.exists (fun p -> is_same p.item (Task v)) before in
  let place (v, place) = if runs v then None else Some (v, Some (Whereabouts.at place)) in
  let places = List.filter_map place seen in
  let others = List.filter (fun (v, _) -> not (List.mem_assoc v places)) s.elsewhere in
  let elsewhere = List.sort Stdlib.compare (places @ others) in
  let s, fresh = with_pending o ~before ~over:None [] { s with outside; date; elsewhere } in
  let since p =
    match p.item with
    | Date _ -> latest * 1000
    | item -> if List.exists (is_same item) fresh then 0 else began item
  in
  { s with pending = List.map (fun p -> shortened (now - since p) p) s.pending }

(* {1 Where vehicles are} *)

let moved elsewhere v place = List.sort Stdlib.compare ((v, place) :: List.remove_assoc v elsewhere)

(* Where a vehicle is after a task, or some part of it, if the task has a place. *)
let moved_by change here (p : Core.platform_task) =
  match p.plan with Some plan when Durations.moves p -> Some (change here plan) | Some _ | None -> None

let gone o s v change elsewhere =
  let task (p : pending) = if is_same p.item (Task v) then p.task else None in
  let there = Option.bind (List.find_map task s.pending) (moved_by change (place o s.elsewhere v)) in
  Option.fold there ~none:elsewhere ~some:(moved elsewhere v)

let in_turn o s v ps =
  let add (here, found) p =
    (Option.value (moved_by Whereabouts.after here p) ~default:here, o.durations.task v here p :: found) in
  List.rev (snd (List.fold_left add (place o s.elsewhere v, []) ps))

let elsewhere_after o s (t : Transition.t) (event : Transition.event option) =
  let stop elsewhere : Effect.t -> _ = function
    | Stop v -> gone o s v Whereabouts.along elsewhere
    | _ -> elsewhere
  in
  let elsewhere =
    match event with
    | Some (Vehicle_done v) -> gone o s v Whereabouts.after s.elsewhere
    | Some (Vehicle_failed (v, _)) -> gone o s v Whereabouts.along s.elsewhere
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
  let matters = Faults.is_possible o.environment.faults.loss || has_links o in
  if matters then List.fold_left set s.patience t.effects else []

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

(* The bounds of an event within [bounds] when the link may be silent: later by the length of the silence. *)
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

(* A vehicle in reach is recruited at once, like a step of the program itself. *)
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
  | Some (Vehicle_failed (v, _)) when is_silent o s v -> with_bounds Fun.id (Some (Silence v))
  | Some (Vehicle_failed (v, why)) ->
    let _, failed, lost = ends_of o s v in
    Some (Task v, if why = Environment.loss then lost else failed)
  | Some (Recruited _) when not (is_event o s choice) -> None
  | Some event -> with_bounds Fun.id (of_event event)
  | None when is_pick && comes_late choice.transition ->
    with_bounds Bounds.from_the_start (Some (Timer Residual.script_timer))
  | None when is_pick && not (has_links o) -> Some (Timer Residual.script_timer, Bounds.at_once)
  | None -> None

let impatient v =
  "while nothing is heard of " ^ v ^ ", its connection timeout changes: the effect on time is unknown here"

(* How long a link has been silent is not asked when the program changes its patience. *)
let check_patience o s next =
  let check (p : pending) =
    match p.item with
    | Silence v when List.exists (fun q -> is_same q.item p.item) s.pending && patience o s v <> patience o next v ->
      raise (Environment.Unclear (Fault.make Fault.unknown_site (impatient v)))
    | _ -> ()
  in
  List.iter check next.pending

let step o s (choice : Environment.choice) =
  let t = choice.transition in
  let next, fresh =
    with_pending o ~before:s.pending ~over:(Option.bind choice.on of_event) t.effects
      { s with configuration = t.next; outside = choice.outside; elsewhere = elsewhere_after o s t choice.on;
               patience = patience_after o s t }
  in
  check_patience o s next;
  { transition = t; due = due o s choice; fresh; next;
    urgent = (not (is_event o s choice)) && (not (may_wait t)) && not (comes_late t) }

let taken o s ~on transition = step o s { transition; outside = s.outside; on }

(* An impossible event is not a step, and an event possible at once bounds nothing. *)
let is_possible step = match step.due with Some (_, Never) -> false | Some (_, (Within _ | Some_time)) | None -> true

let starts_without_moving step =
  match step.transition.effects with [ Start (_, p) ] -> not (Durations.moves p) | _ -> false

(* {2 Steps outside of the program} *)

let is_of_program step = step.transition.rules <> []

(* That [item] is over leads to [next], in which [before] was pending. *)
let of_outside s ~before ~over due next o =
  let transition : Transition.t =
    { rules = []; label = Silent; next = s.configuration; effects = []; assumed = []; otherwise = [] } in
  let next, fresh = with_pending o ~before ~over [] next in
  { transition; due; fresh; next; urgent = false }

let date_step o s =
  let reached k =
    let over = Some (Date k) in
    of_outside s ~before:s.pending ~over (Some (Date k, bounds_of s (Date k))) { s with date = repeated o k } o
  in
  Option.map reached (next_date o s.configuration s.date)

(* The link of [v] comes or goes. The items waiting for it go on, as new ones: the order is carried out, and the end
   is reported. *)
let link_step o s =
  let changed (v, _) =
    let goes_on p = p.item = Task v && is_silent o s v && p.progress <> Under_way in
    let again p = { p with progress = Under_way; bounds = if p.progress = Over then Bounds.at_once else p.bounds } in
    let going_on, before = List.partition goes_on s.pending in
    let step = of_outside s ~before ~over:None (Some (Links, bounds_of s Links)) { s with changes = s.changes + 1 } o in
    let task p = match List.find_opt (fun q -> is_same p.item q.item) going_on with Some q -> again q | None -> p in
    { step with next = { step.next with pending = List.map task step.next.pending } }
  in
  Option.map changed (change o s)

(* A task that is over while nothing is heard of its vehicle. It may be over sooner: that it ends as soon as its link is
   back is among what may happen to one that is under way. *)
let unheard_ends o s =
  let over p =
    match p.item, p.bounds with
    | Task v, Within { most; _ } when is_silent o s v && p.progress = Under_way ->
      let before = List.map (fun q -> if q == p then { p with progress = Over } else q) s.pending in
      Some (of_outside s ~before ~over:None (Some (p.item, Within { least = most; most })) s o)
    | _ -> None
  in
  List.filter_map over s.pending

(* {2 Who is there} *)

(* The assumptions about the whole fleet in [s]. *)
let attendance o s =
  let links = links o in
  let silent = Links.silent links s.changes in
  let late = List.filter (fun v -> not (List.mem v silent)) (Links.late links) in
  List.map (fun v -> World.Late v) late @ List.map (fun v -> World.Missing v) silent

(* It matters where vehicles are looked for. *)
let in_whole_fleet o s step =
  let t = step.transition in
  let looks =
    match s.configuration.control, t.label with
    | Waiting (_, Pick _), _ | _, Recruit _ -> true
    | (Script _ | Waiting _ | Executing _ | Ended _), _ -> false
  in
  if not (is_of_program step) then None
  else if looks then Some { t with assumed = attendance o s @ t.assumed }
  else Some t

let transitions o s steps =
  let add (s, found) step = (step.next, in_whole_fleet o s step :: found) in
  List.rev (snd (List.fold_left add (s, []) steps))

let world o s =
  let world = World.suppose (attendance o s) o.world in
  if o.program.reads_now then World.at (Since s.date) world else world

(* The order is given up, and so is the task. *)
let given_up o world s =
  let fails (p : pending) =
    match p.item with
    | Silence v ->
      let event = Transition.Vehicle_failed (v, Environment.loss) in
      let choice : (Transition.t, Transition.refusal) result -> Environment.choice option = function
        | Ok transition -> Some { transition; outside = s.outside; on = Some event }
        | Error _ -> None
      in
      List.filter_map choice (Environment.clear (Transition.accept_all o.program world s.configuration event))
    | _ -> []
  in
  List.concat_map fails s.pending

(* Nothing is heard of its end. *)
let is_heard o s (choice : Environment.choice) =
  match choice.on with
  | Some (Vehicle_done v | Vehicle_failed (v, _)) -> not (is_silent o s v)
  | Some _ | None -> true

let all_steps ?(tick = ignore) o s =
  let world = world o s in
  let with_step (choice : Environment.choice) =
    tick ();
    (choice, step o s choice)
  in
  let choices =
    Environment.choices_on o.environment o.program world s.outside s.configuration
    |> Seq.filter (is_heard o s) |> Fun.flip Seq.append (List.to_seq (given_up o world s))
    |> Seq.map with_step |> Seq.filter (fun (_, step) -> is_possible step) |> List.of_seq
  in
  let all = List.map snd choices @ Option.to_list (date_step o s) in
  if not (List.exists (fun step -> step.urgent) all) then
    all @ unheard_ends o s @ Option.to_list (link_step o s)
  else if List.exists (fun step -> comes_late step.transition) all then
    List.map (fun step -> { step with urgent = false }) all
  else
    let own (choice, step) = if is_event o s choice then None else Some step in
    List.filter_map own choices

let comes_first o step = step.urgent && starts_without_moving step && not o.program.asks_running

let enough o step_of all =
  match List.find_opt (fun x -> comes_first o (step_of x)) all with Some first -> [ first ] | None -> all

let steps o s = enough o Fun.id (all_steps o s)

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
  let waits = Environment.only_recruits o.environment s.outside (List.map (fun step -> step.transition) steps) in
  (not (Configuration.has_ended c)) && waits && not (Environment.owes o.environment o.program s.outside)
