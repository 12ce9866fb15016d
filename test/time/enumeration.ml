open Dolphin_semantics
open Dolphin_environment
open Dolphin_time

type moment = Ended of Timed_system.ending | Task of Timed_analysis.task * Timed_system.moment
type battery = { at_first : int; work : int; rest : int; charges : (string * int) list }
type t = { dates : (moment * (int * int)) list; never_over : bool; most : (Core.vehicle * int) list }

(* The awaited events: of a vehicle, a timer, an input, or the answers of people and the supplier; and the silence of
   a vehicle that has a task. *)
type awaited = Vehicle of string | Timer of int | Input of string | Word | Quiet of string

(* Of a vehicle whose link is silent, if its task is not under way: the order waits, or it has ended, well or not. *)
type errand = Waits | Ended_well | Ended_badly

(* The seconds since the wait for an event began that comes from the first to the second number of seconds. *)
type clock = { since : int; least : int; most : int }

type state = {
  c : Configuration.t;
  e : Environment.t;
  clocks : (awaited * clock) list;  (* in order *)
  patience : (string option * int) list;
  now : int;
  date : int;  (* as code reads it: dates of one moment pass in any order *)
  missing : (Core.vehicle * (int * int)) list;  (* now, and at the most until now; in order *)
  changes : int;  (* of links, so far *)
  errands : (Core.vehicle * errand) list;  (* in order *)
}

module Table = Hashtbl.Make (struct
    type t = state

    let equal a b =
      a.now = b.now && a.date = b.date && a.changes = b.changes && a.errands = b.errands &&
      a.missing = b.missing && a.clocks = b.clocks && a.patience = b.patience
      && Environment.compare a.e b.e = 0
      && Configuration.equal a.c b.c

    let hash s = Hashtbl.hash (s.now, s.date, s.changes, s.errands, s.missing, s.clocks, Configuration.hash s.c)
  end)

exception Too_much

(* Only nodes that follow a node, and are followed by one, again and again: what is left has a cycle. *)
let rec core edges =
  let follows = Hashtbl.create 100 and is_followed = Hashtbl.create 100 in
  let note (i, _, j) =
    Hashtbl.replace is_followed i ();
    Hashtbl.replace follows j ()
  in
  List.iter note edges;
  let left = List.filter (fun (i, _, j) -> Hashtbl.mem follows i && Hashtbl.mem is_followed j) edges in
  if List.compare_lengths left edges = 0 then edges else core left

let contradiction edges =
  let assumed = List.sort_uniq World.compare_assumption (List.concat_map (fun (_, assumed, _) -> assumed) edges) in
  let pair a = Option.map (fun b -> (a, b)) (List.find_opt (World.contradict a) assumed) in
  List.find_map pair assumed

(* Whether a graph has a cycle whose assumptions some moment has. [edges] leads from a state to one that follows. All
   cycles are at one second. *)
let rec is_cyclic edges =
  match core edges with
  | [] -> false
  | core -> (
      match contradiction core with
      | None -> true
      | Some (a, b) ->
        let is c a = World.compare_assumption c a = 0 in
        let without c = is_cyclic (List.filter (fun (_, assumed, _) -> not (List.exists (is c) assumed)) core) in
        without a || without b)

let in_seconds : Bounds.t -> int * int = function
  | Within { least; most } -> (least / 1000, most / 1000)
  | Some_time | Never -> raise_notrace Too_much

let whole x = Float.to_int x

let clock_of (o : Clocked.options) (deed : Effect.t) =
  let set what (least, most) = [ (what, { since = 0; least; most }) ] in
  match deed with
  | Start (v, p) -> set (Vehicle v) (in_seconds (o.durations.task v None p))
  | Set_timer (i, n) -> set (Timer i) (whole n, whole n)
  | Put_question (i, _) -> set (Timer i) (0, max_int)
  | Look_for { timeout = Some n; _ } -> set (Timer 0) (whole n, whole n)
  | Look_for { timeout = None; _ } -> set (Timer 0) (in_seconds o.durations.announced)
  | Ask _ | Call_host _ -> set Word (0, 0)
  | _ -> []

let inputs (o : Clocked.options) c e =
  match c.Configuration.control with
  | Ended _ -> []
  | _ ->
    List.sort_uniq compare (List.map (fun (k, _, _) -> k) (Environment.inputs o.environment o.program e))

(* If vehicles may be late, they come at any time; if links may be lost, so may they. *)
let links (o : Clocked.options) =
  match o.environment.faults with
  | { join = Never; loss = Never; _ } -> o.durations.links
  | { join = Never; _ } -> Links.only_first o.durations.links
  | _ -> Links.none

let is_silent o s v = Links.is_silent (links o) s.changes v

let awaited o s (c : Configuration.t) e =
  let what : Transition.awaited -> awaited option = function
    | End_of v -> Some (Vehicle v)
    | Expiry_of i | Answer_to (i, _) -> Some (Timer i)
    | Answer | Reply -> Some Word
    | Recruit_for _ -> None (* a vehicle is recruited at once, or may stay away for any time *)
  in
  let of_task = List.filter_map what (Transition.awaited c) in
  let quiet = function Vehicle v when is_silent o s v -> Some (Quiet v) | _ -> None in
  of_task @ List.filter_map quiet of_task @ List.map (fun k -> Input k) (inputs o c e)

let patience (o : Clocked.options) s v =
  match List.assoc_opt (Some v) s.patience, List.assoc_opt None s.patience with
  | Some n, _ | None, Some n -> n
  | None, None -> snd (in_seconds o.durations.silence)

let over : Transition.event -> awaited option = function
  | Vehicle_done v | Vehicle_failed (v, _) -> Some (Vehicle v)
  | Timer_expired i | Confirmed (i, _) -> Some (Timer i)
  | Recruited _ -> None
  | Answered _ | Nobody_answers _ | Replied _ | Host_failed _ -> Some Word
  | Input (k, _) -> Some (Input k)
  | Interruption -> None

let posted (o : Clocked.options) k =
  match o.durations.posted k with
  | Within { least; most } -> { since = 0; least = least / 1000; most = most / 1000 }
  | Some_time | Never -> { since = 0; least = 0; most = max_int }

let after o s (choice : Environment.choice) =
  let t = choice.transition in
  let kept = match Option.bind choice.on over with Some what -> List.remove_assoc what s.clocks | None -> s.clocks in
  let set clocks deed =
    let add clocks (what, clock) = (what, clock) :: List.remove_assoc what clocks in
    List.fold_left add clocks (clock_of o deed)
  in
  let clocks = List.fold_left set kept t.effects in
  let find what =
    match what, List.assoc_opt what clocks with
    | _, Some clock -> (what, clock)
    | Input k, None -> (what, posted o k)
    | Quiet v, None -> let n = patience o s v in (what, { since = 0; least = n; most = n })
    | _, None -> failwith "awaited, and never begun"
  in
  let set_patience patience : Effect.t -> _ = function
    | Set_connection_timeout (None, n) -> [ (None, whole n) ]
    | Set_connection_timeout (Some vs, n) ->
      List.fold_left (fun patience v -> (Some v, whole n) :: List.remove_assoc (Some v) patience) patience vs
    | _ -> patience
  in
  let awaited = awaited o s t.next choice.outside in
  let started = List.filter_map (function Effect.Start (v, _) -> Some v | _ -> None) t.effects in
  let waiting = List.map (fun v -> (v, Waits)) (List.filter (is_silent o s) started) in
  let is_kept (v, _) =
    List.mem (Vehicle v) awaited && Option.bind choice.on over <> Some (Vehicle v) && not (List.mem v started) in
  { s with c = t.next; e = choice.outside;
           clocks = List.sort_uniq compare (List.map find awaited);
           errands = List.sort compare (waiting @ List.filter is_kept s.errands);
           patience = List.sort compare (List.fold_left set_patience s.patience t.effects) }

let comes_late (t : Transition.t) = List.exists (function World.Late _ -> true | _ -> false) t.assumed

(* A sensor may never enable it. *)
let is_open (t : Transition.t) =
  t.assumed <> [] && (not (comes_late t))
  && match t.rules with (Condition | Recruit | Allof_when | Oneof_when | Until_cut | Assure_cut) :: _ -> true
                      | _ -> false

(* From how many to how many seconds, of which clock. *)
let due o s (choice : Environment.choice) =
  let clock what = List.assoc what s.clocks in
  let waits v = if List.mem v (Environment.lost s.e) then patience o s v else 0 in
  match choice.on, s.c.control with
  | Some (Vehicle_failed (v, _)), _ when is_silent o s v ->
    let c = clock (Quiet v) in Some (c, c.least, c.most)
  | Some (Vehicle_done v | Vehicle_failed (v, _)), _ when List.mem_assoc v s.errands ->
    let c = clock (Vehicle v) in Some (c, 0, c.since)
  | Some (Vehicle_done v), _ ->
    let c = clock (Vehicle v) in
    Some (c, c.least, c.most + waits v)
  | Some (Vehicle_failed (v, why)), _ ->
    let c = clock (Vehicle v) and silence = patience o s v in
    Some (if why = Environment.loss then (c, silence, c.most + waits v + silence) else (c, 0, c.most + waits v))
  | Some event, _ -> Option.map (fun what -> let c = clock what in (c, c.least, c.most)) (over event)
  | None, Waiting (_, Pick _) when Links.count (links o) = 0 && Links.late (links o) = [] ->
    let c = clock (Timer 0) in
    Some (c, 0, if comes_late choice.transition then c.most else 0)
  | None, _ -> None

(* Vehicles heard of later than others come after them. *)
let with_those_there o s world =
  let links = links o in
  let silent = Links.silent links s.changes in
  let late = List.filter (fun v -> not (List.mem v silent)) (Links.late links) in
  World.suppose (List.map (fun v -> World.Late v) late @ List.map (fun v -> World.Missing v) silent) world

(* The link of [v] comes or goes. *)
let after_change o s v =
  let s' = { s with changes = s.changes + 1 } in
  let is_back = is_silent o s v in
  let clocks =
    List.filter_map
      (fun (what, clock) ->
         match what with
         | Vehicle w when w = v && is_back && List.assoc_opt v s.errands = Some Waits ->
           Some (what, { clock with since = 0 })
         | Quiet w when w = v -> None
         | _ -> Some (what, clock))
      s.clocks
  in
  let n = patience o s v in
  let quiet =
    if (not is_back) && List.mem_assoc (Vehicle v) s.clocks then [ (Quiet v, { since = 0; least = n; most = n }) ]
    else [] in
  { s' with clocks = List.sort compare (quiet @ clocks);
            errands = List.filter (fun (w, errand) -> not (w = v && errand = Waits)) s.errands }

(* A second later. *)
let tick ~batteries s =
  let later (what, clock) = (what, { clock with since = clock.since + 1 }) in
  let less (v, (missing, most)) =
    let b = List.assoc v batteries in
    let by =
      match Vehicle_map.find_opt v s.c.shared.allocation with
      | Some (p : Core.platform_task) when not (List.mem_assoc v s.errands) ->
        Option.fold (List.assoc_opt p.name b.charges) ~none:b.work ~some:(fun share -> -share)
      | Some _ | None -> -b.rest
    in
    let missing = max 0 (missing + by) in
    (v, (missing, max most missing))
  in
  { s with now = s.now + 1; clocks = List.map later s.clocks; missing = List.map less s.missing }

let all ?(states = 20_000) ?(seconds = 60) ?(batteries = []) ?seen:(show = fun _ _ world -> world) ?(look = ignore)
    (o : Clocked.options) =
  let seen = Table.create 1_000 and queue = Queue.create () in
  let edges = ref [] in
  let dates = Hashtbl.create 20 and most = Hashtbl.create 3 and worked = Hashtbl.create 3 and never_over = ref false in
  let note s moment =
    let least, most = Option.value (Hashtbl.find_opt dates moment) ~default:(s.now, s.now) in
    Hashtbl.replace dates moment (min least s.now, max most s.now)
  in
  let reach ?from ?(assumed = [ [] ]) s =
    if s.now > seconds || Table.length seen > states then raise_notrace Too_much;
    if not (Table.mem seen s) then begin
      Table.add seen s (Table.length seen);
      Queue.add s queue
    end;
    let edge from assumed = (Table.find seen from, assumed, Table.find seen s) in
    Option.iter (fun from -> edges := List.map (edge from) assumed @ !edges) from
  in
  let note_step s (t : Transition.t) =
    let task v (p : Core.platform_task) : Timed_analysis.task = { name = p.name; vehicle = v; site = p.task_site } in
    let running v moment =
      Option.iter (fun p -> note s (Task (task v p, moment))) (Vehicle_map.find_opt v s.c.shared.allocation)
    in
    (match t.label with
     | Done (v, _) -> running v Timed_system.Ends
     | Fail (v, _, _) -> running v Fails
     | _ -> ());
    let carry : Effect.t -> unit = function
      | Start (v, p) ->
        Hashtbl.replace worked v ();
        note s (Task (task v p, Timed_system.Starts))
      | Stop v -> running v Stopped
      | _ -> ()
    in
    List.iter carry t.effects
  in
  let note_most s =
    let note (v, (_, n)) =
      Hashtbl.replace most v (max n (Option.value (Hashtbl.find_opt most v) ~default:0)) in
    List.iter note s.missing
  in
  let note_end s =
    match s.c.control with
    | Ended Completed -> note s (Ended Completed)
    | Ended (Halted _) -> note s (Ended Halted)
    | Ended (Failed _) -> note s (Ended Failed)
    | Ended Interrupted -> note s (Ended Interrupted)
    | Script _ | Waiting _ | Executing _ -> ()
  in
  let expand s =
    note_end s;
    (match s.c.control with Ended _ -> note_most s | Script _ | Waiting _ | Executing _ -> ());
    let world = World.at (Exactly s.date) (with_those_there o s o.world) in
    let world = List.fold_left (fun w (v, (missing, _)) -> show v missing w) world s.missing in
    let choices = List.of_seq (Environment.choices_on o.environment o.program world s.e s.c) in
    let told (choice : Environment.choice) =
      match choice.on with
      | Some (Vehicle_done v) -> (not (is_silent o s v)) && List.assoc_opt v s.errands <> Some Ended_badly
      | Some (Vehicle_failed (v, _)) -> (not (is_silent o s v)) && List.assoc_opt v s.errands <> Some Ended_well
      | Some _ | None -> true
    in
    let given_up (what, _) =
      match what with
      | Quiet v -> (
          match Transition.accept_all o.program world s.c (Vehicle_failed (v, Environment.loss)) with
          | Ok found ->
            List.filter_map
              (function
                | Ok transition ->
                  Some { Environment.transition; outside = s.e; on = Some (Vehicle_failed (v, Environment.loss)) }
                | Error _ -> None)
              found
          | Error _ -> [])
      | _ -> []
    in
    let told_choices = List.filter told choices @ List.concat_map given_up s.clocks in
    let timed = List.map (fun choice -> (choice, due o s choice)) told_choices in
    (* Tasks that end unheard. *)
    let ends_unheard (choice : Environment.choice) =
      match choice.on with
      | Some (Vehicle_done v | Vehicle_failed (v, _)) when is_silent o s v && not (List.mem_assoc v s.errands) ->
        let clock = List.assoc (Vehicle v) s.clocks in
        let well = match choice.on with Some (Vehicle_done _) -> true | _ -> false in
        let least = if well then clock.least else 0 in
        Some (v, (if well then Ended_well else Ended_badly), clock, least, clock.most)
      | _ -> None
    in
    let unheard = List.filter_map ends_unheard choices in
    let is_by_itself (choice : Environment.choice) =
      match choice.on with
      | None -> true
      | Some (Recruited (_, v)) ->
        choice.transition.assumed = [] && not (Environment.may_stay_away o.environment s.e v)
      | Some _ -> false
    in
    let is_own (choice, _) = is_by_itself choice && not (comes_late choice.Environment.transition) in
    let is_urgent (choice, due) = is_own (choice, due) && not (is_open choice.Environment.transition) in
    let own = if List.exists is_urgent timed then List.filter is_own timed else [] in
    let waits_for_others = List.exists (fun ((c : Environment.choice), _) -> comes_late c.transition) timed in
    let possible = if own <> [] && not waits_for_others then own else timed in
    let may_be_now (_, due) =
      match due with
      | Some (clock, least, most) -> clock.since >= least && clock.since <= most
      | None -> true
    in
    let last clock =
      List.fold_left
        (fun last (_, due) -> match due with Some (c, _, most) when c == clock -> max last most | _ -> last)
        (-1) possible
    in
    let waits = own = [] || waits_for_others in
    let changes_later = match s.c.control with Ended _ -> false | _ -> s.changes < Links.count (links o) in
    let is_next_there = waits && changes_later && snd (Links.change (links o) s.changes) <= 1000 * s.now in
    (* Time has passed because something might be lost, and something else was lost: that is not a run. *)
    let is_overdue (_, clock) = match last clock with -1 -> false | most -> clock.since > most in
    (* A task has failed unheard, and since then another failure was heard of, after which no more may come: that is not
       a run. *)
    let is_too_many (v, errand) =
      let fails (choice : Environment.choice) =
        match choice.on with Some (Vehicle_failed (w, _)) -> String.equal v w | _ -> false in
      errand = Ended_badly && not (List.exists fails choices)
    in
    let is_not_a_run () =
      List.exists is_overdue s.clocks
      || List.exists (fun (v, errand) -> is_too_many (v, errand) && not (is_silent o s v)) s.errands
    in
    let take ((choice : Environment.choice), _) =
      note_step s choice.transition;
      let t = choice.transition in
      reach ~from:s ~assumed:(t.assumed :: t.otherwise) (after o s choice)
    in
    if not (waits && is_not_a_run ()) then begin
      look s.c;
      List.iter take (List.filter may_be_now possible);
      let end_unheard (v, errand, clock, least, most) =
        if waits && clock.since >= least && clock.since <= most then
          reach ~from:s { s with errands = List.sort compare ((v, errand) :: s.errands) }
      in
      List.iter end_unheard unheard;
      if is_next_there then reach ~from:s (after_change o s (fst (Links.change (links o) s.changes)))
    end;
    let reads_date = o.program.reads_now and is_over = match s.c.control with Ended _ -> true | _ -> false in
    if reads_date && waits && (not is_over) && s.date < s.now && not (is_not_a_run ()) then
      reach ~from:s { s with date = s.now };
    let dates = Result.value o.dates ~default:Dated_code.no_dates in
    let is_dated = (not is_over) && Dated_code.following dates s.date <> None in
    (* A second passes, if for everything that is awaited something may still happen then. *)
    let is_under_way (_, _, clock, _, most) = clock.since < most in
    let may_wait (_, clock) =
      (match last clock with -1 -> true | most -> clock.since < most)
      && List.for_all is_under_way (List.filter (fun (_, _, c, _, _) -> c == clock) unheard) in
    let is_up_to_date = ((not reads_date) || s.date = s.now) && not is_next_there in
    let is_something_to_come = changes_later || unheard <> [] || is_dated in
    let may_pass = (possible <> [] || is_something_to_come) && List.for_all may_wait s.clocks in
    if waits && is_up_to_date && may_pass && not (is_not_a_run ()) then begin
      if is_something_to_come
      || List.exists (fun (choice, _) -> not (Environment.is_voluntary choice.Environment.transition)) possible
      || Environment.owes o.environment o.program s.e
      then reach ~from:s (tick ~batteries s)
    end;
    match s.c.control with
    | Ended _ -> ()
    | Script _ | Waiting _ | Executing _ ->
      let transitions = List.map (fun ((choice : Environment.choice), _) -> choice.transition) timed in
      if (not changes_later) && (not (List.exists is_too_many s.errands)) && (not is_dated)
         && Environment.only_recruits o.environment s.e transitions
         && not (Environment.owes o.environment o.program s.e)
      then never_over := true
  in
  let start =
    let c = Configuration.initial o.program and e = Environment.initial in
    { c; e; now = 0; date = 0; patience = []; changes = 0; errands = [];
      missing = List.sort compare (List.map (fun (v, b) -> (v, (b.at_first, b.at_first))) batteries);
      clocks = List.sort compare (List.map (fun k -> (Input k, posted o k)) (inputs o c e)) }
  in
  match
    reach start;
    while not (Queue.is_empty queue) do
      expand (Queue.pop queue)
    done
  with
  | () ->
    let never_over = !never_over || is_cyclic !edges in
    let sorted table = List.sort compare (List.of_seq (Hashtbl.to_seq table)) in
    let works (v, _) = Hashtbl.mem worked v in
    Some { dates = sorted dates; never_over; most = List.filter works (sorted most) }
  | exception (Too_much | Environment.Unclear _) -> None
