open Dolphin_semantics
module System = Dolphin_checker.System
module Numbering = Dolphin_checker.Numbering
module Looks = Dolphin_explore.Looks

type goal = Latest | Earliest
type via = unit
type property = unit
type date = At of int | Unbounded
type moment = Happening.moment = Starts | Ends | Fails | Stopped
type task = Happening.task = { name : string; vehicle : Core.vehicle; site : Core.site }
type ending = Completed | Halted | Failed | Interrupted
let ending_name = function
  | Completed -> "completed"
  | Halted -> "halted"
  | Failed -> "failed"
  | Interrupted -> "interrupted"

let moment_name = function Starts -> "starts" | Ends -> "ends" | Fails -> "fails" | Stopped -> "stopped"

type cycle = { from : int; last : int; back : Clocked.step; in_no_time : bool }

exception Broken = Zone_node.Broken

type reduction = Successors.reduction = Nothing | Inert_ends | Inert_ends_and_canonical_states

type move =
  | Step of { step : Clocked.step; begun : Inert.item list; last : Clocked.item option; items : Clocked.item list }
  | Rest of { steps : Clocked.step list; later : bool }

type arrival = {
  move : move;
  into : Clocked.state;
  items : Clocked.item list;
  execution : Canonical_state.execution option;
}

type passage = {
  may_do : Dolphin_scenario.Battery.doing list;
  least : int;
  most : int option;
  turns : bool;
  seen : Course.range;
  binds : bool;
}
type edge = { source : int; target : int; by : move; working : Working.t; passage : passage option }

(* The states that follow a state are looked for in its turn, or never if a later state includes it. *)
type turn = To_come | Taken | Included_in of int

type node = { place : Zone_node.t; zone : Zone.t; parent : int; move : move option; mutable turn : turn }

type t = {
  numbering : Numbering.t;
  goal : goal;
  start : Clocked.state;
  options : Clocked.options;
  course : Course.t option;
  places : Zone_node.places;
  mutable reduced : bool;  (* whether anything was inert, or states might be alike *)
  mutable nodes : node array;
  mutable count : int;
  mutable reserved : int;
  moments : (task * moment, date) Hashtbl.t;
  mutable tasks : task list;  (* latest first *)
  mutable endings : (ending * (date * int)) list;
  mutable edges : edge list option;  (* latest first *)
  mutable edge_count : int;
  mutable cycle : cycle option;
  mutable returns : (int * int * move) list;  (* a move from one state leads to just another one that there was *)
  mutable stuck : int option;
  mutable unknown : Clocked.pending list;
  deadlines : Core.site list ref;  (* of [within], latest first *)
  missed : (Core.site, date * int * Zone_node.arrow) Hashtbl.t;
}

(* {1 What is found} *)

let date t zone =
  match t.goal with
  | Earliest -> At (Zone.earliest_date zone)
  | Latest -> Option.fold ~none:Unbounded ~some:(fun n -> At n) (Zone.latest_date zone)

let is_better t a b =
  match t.goal, a, b with
  | Latest, Unbounded, At _ -> true
  | Latest, At m, At n -> m > n
  | Earliest, At m, At n -> m < n
  | (Latest | Earliest), _, _ -> false

let note_one t date task moment =
  match Hashtbl.find_opt t.moments (task, moment) with
  | Some known when not (is_better t date known) -> ()
  | Some _ -> Hashtbl.replace t.moments (task, moment) date
  | None ->
    if not (List.mem task t.tasks) then t.tasks <- task :: t.tasks;
    Hashtbl.replace t.moments (task, moment) date

let note_unknown t (s : Clocked.state) =
  let note (p : Clocked.pending) =
    let same (q : Clocked.pending) = q.item = p.item && q.prompt = p.prompt && Option.equal ( == ) q.task p.task in
    let is_sure = match p.item with Recruit _ -> not (Clocked.may_wait_for_recruits t.options) | _ -> false in
    if p.bounds = Some_time && (not is_sure) && not (List.exists same t.unknown) then t.unknown <- p :: t.unknown
  in
  List.iter note s.pending

(* Of all tasks that automorphisms make of [task]. *)
let note_task t execution date task moment =
  match execution with
  | None -> note_one t date task moment
  | Some e -> List.iter (fun task -> note_one t date task moment) (Canonical_state.orbit e task)

let note_step t execution zone (before : Clocked.state) (step : Clocked.step) =
  let date = date t zone in
  List.iter (fun (moment, task) -> note_task t execution date task moment) (Happening.tasks before step)

(* Inert parts take their bounds, one after the other, in any context. *)
let note_begun t execution zone begun =
  let after ms date = match date with At n -> At (n + ms) | Unbounded -> Unbounded in
  let note date (p : Inert.part) =
    let over = after (match t.goal with Latest -> p.most | Earliest -> p.least) date in
    let note_moments task =
      note_task t execution date task Starts;
      note_task t execution over task Ends
    in
    Option.iter note_moments (Happening.task_of_part p);
    over
  in
  List.iter (fun (i : Inert.item) -> ignore (List.fold_left note (date t zone) i.parts)) begun

(* [arrow] is taken from state [n]. *)
let note_missed t n zone before (arrow : Zone_node.arrow) =
  let date = date t zone in
  let note site =
    match Hashtbl.find_opt t.missed site with
    | Some (known, _, _) when not (is_better t date known) -> ()
    | Some _ | None -> Hashtbl.replace t.missed site (date, n, arrow)
  in
  Option.iter note (Happening.missed before arrow.step)

let ending : Configuration.ending -> ending = function
  | Completed -> Completed
  | Halted _ -> Halted
  | Failed _ -> Failed
  | Interrupted -> Interrupted

let note_end t number node =
  match node.place.state.configuration.control with
  | Ended e ->
    let e = ending e and date = date t node.zone in
    (match List.assoc_opt e t.endings with
     | Some (known, _) when not (is_better t date known) -> ()
     | Some _ | None -> t.endings <- (e, (date, number)) :: List.remove_assoc e t.endings)
  | Script _ | Waiting _ | Executing _ -> ()

(* {1 Numbers} *)

let add t node =
  if t.count = Array.length t.nodes then begin
    let nodes = Array.make (max 1_024 (2 * t.count)) node in
    Array.blit t.nodes 0 nodes 0 t.count;
    t.nodes <- nodes
  end;
  let number = t.count in
  t.nodes.(number) <- node;
  t.count <- number + 1;
  Zone_node.add node.place number;
  note_end t number node;
  number

let rec is_before t m n = m = n || (n > m && is_before t m t.nodes.(n).parent)

(* The looks from state [m] to state [n], which it leads to. *)
let looks_of = function Step { step; _ } -> Looks.of_transition step.transition | Rest _ -> Looks.none

let rec looks_between t m n =
  if n = m then []
  else
    match t.nodes.(n) with
    | { move = Some move; parent; _ } -> looks_of move :: looks_between t m parent
    | { move = None; _ } -> []

(* A run goes round in no time only if sensors show one thing all the way. *)
let is_possible_in_no_time t looks = Looks.agree (Looks.at_one_moment t.options.program) looks

(* A step from state [n] leads back to an earlier state of the run to it. *)
let find_cycle t n move (place : Zone_node.t) zone =
  let comes_back m =
    let by = Zone.delayed t.nodes.(m).zone zone in
    if by >= 0 && is_before t m n then Some (m, by) else None
  in
  match t.goal with
  | Earliest -> None
  | Latest ->
    let found = List.find_map comes_back place.here in
    let is_possible (m, by) =
      by > 0 || Zone.latest_date t.nodes.(m).zone = None
      || is_possible_in_no_time t (looks_of move :: looks_between t m n) in
    let note (m, by) =
      if t.reduced then raise Broken;
      let known = match t.cycle with Some c -> not c.in_no_time || by = 0 | None -> false in
      match move with
      | Step { step; _ } when not known -> t.cycle <- Some { from = m; last = n; back = step; in_no_time = by = 0 }
      | Step _ | Rest _ -> ()
    in
    Option.iter (fun cycle -> if is_possible cycle then note cycle) found;
    found

(* A state that includes [zone] of [place]: there, or where fewer waits share clocks. *)
let including t (place : Zone_node.t) zone =
  let find (place : Zone_node.t) zone = List.find_opt (fun m -> Zone.subset zone t.nodes.(m).zone) place.here in
  let find_wider ((wider : Zone_node.t), seen) = if wider.here = [] then None else find wider (seen zone) in
  match find place zone with
  | Some _ as found -> found
  | None -> List.find_map find_wider place.wider

(* States that state [n] includes, and whose turn is to come, need no turn. *)
let stand_for_included t n =
  let { place; zone; _ } = t.nodes.(n) in
  let among (place : Zone_node.t) seen =
    let stand_for m =
      let other = t.nodes.(m) in
      if m <> n && other.turn = To_come && Zone.subset (seen other.zone) zone then begin
        other.turn <- Included_in n;
        Zone_node.remove place m
      end
    in
    List.iter stand_for place.here
  in
  among place Fun.id;
  List.iter (fun (place, seen) -> among place seen) place.narrower

(* The number of the state that stands for [place] with [zone], to which [move] leads from state [n]. *)
let arrive t n move (place : Zone_node.t) zone =
  let new_state zone =
    let number = add t { place; zone; parent = n; move = Some move; turn = To_come } in
    stand_for_included t number;
    number
  in
  match find_cycle t n move place zone with
  | Some (m, by) when by > 0 && Zone.latest_date t.nodes.(m).zone <> None ->
    (* Once more and once more: at any later date. *)
    let zone = Zone.at_any_date t.nodes.(m).zone in
    (match including t place zone with Some m -> m | None -> new_state zone)
  | Some _ | None -> (
      match including t place zone with
      | Some m ->
        let { place = known; zone = other; _ } = t.nodes.(m) in
        if t.goal = Latest && known == place && Zone.equal zone other then t.returns <- (n, m, move) :: t.returns;
        m
      | None -> new_state zone)

let ( let* ) = Option.bind

(* {1 The system} *)

exception Outgrown

let words _ = 1
let number t word = word lsr t.reserved

let widen t ~reserved =
  let before = t.reserved in
  t.reserved <- reserved;
  fun old fresh -> fresh.(0) <- (old.(0) lsr before) lsl reserved

let numbers t key f = f (number t key.(0))

let create ?(working = false) ?start goal successors =
  let filled = match goal with Latest -> Zone.reaching_down | Earliest -> Zone.reaching_up in
  let deadlines = ref [] in
  let note s =
    let add (_, site) = if not (List.mem site !deadlines) then deadlines := site :: !deadlines in
    List.iter add (Happening.deadlines s)
  in
  let places = Zone_node.places successors ~filled ~note in
  let options = Successors.options successors and course = Successors.course successors in
  let start = match start with Some start -> start | None -> Clocked.initial options in
  { numbering = Numbering.create (); goal; start; options; course; places; reduced = false; nodes = [||]; count = 0;
    reserved = 0; moments = Hashtbl.create 100; tasks = []; endings = []; cycle = None; returns = [];
    edges = (if working || course <> None then Some [] else None); edge_count = 0;
    stuck = None; unknown = []; deadlines; missed = Hashtbl.create 8 }

let visit t (v : via System.visitor) n = v.visit [| n lsl t.reserved |] 0 ()

let initial t v =
  if t.count = 0 then begin
    let state = t.start in
    let awaited = List.map (fun (p : Clocked.pending) -> p.item) state.pending in
    let fresh = Option.to_list (Zone_node.course_item t.places) @ awaited in
    let place, _, zone =
      Zone_node.reached t.places ~clocks:[] ~rest_clock:None ~fresh ~has_rest:false None state [] Zone.start No_rest
    in
    let settled () = Zone_node.settled t.places place zone in
    match Successors.ticking (Zone_node.successors t.places) v.System.tick settled with
    | Some zone -> ignore (add t { place; zone; parent = -1; move = None; turn = To_come })
    | None -> assert false  (* nothing is over at the start *)
  end;
  visit t v 0

let note_reduced t =
  if t.cycle <> None then raise Broken;
  t.reduced <- true

(* More would take more memory than their information is worth. *)
let most_edges = 1_000_000

let note_edge t source target by working passage =
  let note edges =
    t.edge_count <- t.edge_count + 1;
    t.edges <- if t.edge_count > most_edges then None else Some ({ source; target; by; working; passage } :: edges)
  in
  Option.iter note t.edges

(* How long the course has gone on in [zone], whose clocks are those of [place]. *)
let since t (place : Zone_node.t) zone =
  let clock = Option.bind (Zone_node.course_item t.places) (fun item -> List.assoc_opt item place.clocks) in
  Option.fold clock ~none:(0, None) ~some:(fun clock -> (Zone.least clock zone, Zone.most clock zone))

(* The course until something is done in [zone] of [before]: [step], or what does not matter to it. *)
let passage t (before : Zone_node.t) zone step =
  let of_course c =
    let least, most = since t before zone in
    let may_do = Course.may_do c before.state in
    match step with
    | None -> { may_do; least; most; turns = false; seen = Course.anything; binds = false }
    | Some (step : Clocked.step) ->
      let is_first = Zone.latest_date zone = Some 0 in
      let is_last = Configuration.has_ended step.next.configuration in
      { may_do; least; most; turns = Course.turns c before.state step; seen = Course.seen c before.state step;
        binds = Course.is_newly_bound c step && not (is_first || is_last) }
  in
  Option.map of_course t.course

(* The states that [arrow] leads to from those valuations of state [n] that are in [zone]. *)
let take t n (before : Zone_node.t) zone ({ step; inert; begun; spelled } as arrow : Zone_node.arrow) =
  match Zone_node.enabling before zone step with
  | None -> []
  | Some zone ->
    let execution = Zone_node.execution_after t.places before step.next in
    note_step t before.execution zone before.state step;
    note_missed t n zone before.state arrow;
    note_begun t execution zone begun;
    if begun <> [] || execution <> None then note_reduced t;
    let lasts = Zone_node.lasts before begun in
    let has_rest = List.exists (fun (_, rest) -> rest <> Zone_node.No_rest) lasts in
    let at =
      let { Zone_node.clocks; rest_clock; _ } = before in
      let fresh = Zone_node.fresh t.places before.state step and spelled = Option.map spelled execution in
      Zone_node.reached t.places ~clocks ~rest_clock ~fresh ~has_rest spelled step.next inert zone
    in
    let working =
      if t.edges = None || t.course <> None then [] else Working.of_step t.options before zone arrow execution in
    let passage = passage t before zone (Some step) in
    let into (last, rest) =
      let place, items, zone = at rest in
      let* zone = Zone_node.with_begun place begun last zone in
      let* zone = Zone_node.settled t.places place zone in
      let move = Step { step; begun; last; items } in
      let target = arrive t n move place zone in
      note_edge t n target move working passage;
      Some target
    in
    List.filter_map into lasts

(* The states that the end of the rest leads to. *)
let end_rest t n (before : Zone_node.t) zone =
  match before.rest, before.rest_clock with
  | Said, Some clock ->
    let steps = Zone_node.ends_of_rest t.places before.state in
    let last = List.nth steps (List.length steps - 1) in
    Zone_node.check_left t.places before last.next;
    let clocks =
      let is_course (item, _) = Some item = Zone_node.course_item t.places in
      List.filter is_course before.clocks
    in
    let into (zone, later) =
      let passage = passage t before zone None in
      let place, _, zone =
        Zone_node.reached t.places ~clocks ~rest_clock:None ~fresh:last.fresh ~has_rest:false None last.next [] zone
          No_rest
      in
      let* zone = Zone_node.settled t.places place zone in
      let move = Rest { steps; later } in
      let target = arrive t n move place zone in
      note_edge t n target move [] passage;
      Some target
    in
    let ends = [ Zone_node.ends_now clock zone; Zone_node.ends_later clock zone ] in
    List.filter_map (fun found -> Option.bind found into) ends
  | (No_rest | Unsaid | Said), _ -> []

let expand_state t n (v : via System.visitor) =
  let { place = before; zone; _ } = t.nodes.(n) in
  let visited ns = List.iter (visit t v) ns; List.length ns in
  if Inert.is_rest before.state before.inert then visited (end_rest t n before zone)
  else begin
    let arrows = Zone_node.arrows t.places before in
    if Clocked.is_stuck t.options before.state (Zone_node.steps t.places before) then begin
      if before.inert <> [] then raise Broken;
      if t.stuck = None then t.stuck <- Some n
    end;
    let follow taken arrow =
      v.tick ();
      taken + visited (take t n before zone arrow)
    in
    List.fold_left follow 0 arrows
  end

(* With many inputs a state has many steps, and so has each of its successors. *)
let expand t key (v : via System.visitor) =
  Zone_node.check_dates t.places;
  let n = number t key.(0) in
  note_unknown t t.nodes.(n).place.state;
  match t.nodes.(n).turn with
  | Included_in _ -> 0
  | To_come | Taken ->
    t.nodes.(n).turn <- Taken;
    Successors.ticking (Zone_node.successors t.places) v.tick (fun () -> expand_state t n v)

(* One process searches. *)
let numbering t = t.numbering
let check_fit _ = ()

type findings = unit

let findings _ = ()
let add_findings _ () = ()
let broken _ _ = None
let is_end _ _ = true
let may_cycle _ = false
let is_anchor _ _ = true
let valuation _ _ _ = 0

(* {1 Answers} *)

let tasks t =
  let moments task =
    let find moment = Option.map (fun date -> (moment, date)) (Hashtbl.find_opt t.moments (task, moment)) in
    (task, List.filter_map find [ Starts; Ends; Fails; Stopped ])
  in
  List.rev_map moments t.tasks

let endings t = List.sort Stdlib.compare t.endings
(* {2 Cycles that no run of the search goes round} *)

(* A cycle in the graph of [successors], as the vertices on it with the edges that lead on from them. *)
let cycle_in count successors =
  let entered = Array.make count false and left = Array.make count false in
  let rec around m = function
    | (n, edge) :: _ when n = m -> [ (n, edge) ]
    | step :: path -> step :: around m path
    | [] -> assert false  (* [m] is on the path *)
  in
  (* [path]: from the latest vertex back; with each, the edges from it that are to be followed. *)
  let rec go path = function
    | [] -> None
    | (n, []) :: stack -> left.(n) <- true; go (match path with [] -> [] | _ :: path -> path) stack
    | (n, (m, edge) :: others) :: stack ->
      let stack = (n, others) :: stack in
      if left.(m) then go path stack
      else if entered.(m) then Some (List.rev (around m ((n, edge) :: path)))
      else enter ((n, edge) :: path) stack m
  and enter path stack n =
    entered.(n) <- true;
    go path ((n, successors.(n)) :: stack)
  in
  let rec from n =
    if n = count then None
    else if entered.(n) then from (n + 1)
    else match enter [] [] n with Some found -> Some found | None -> from (n + 1)
  in
  from 0

(* Each state on it is all that the one before leads to, and no date grows: it is gone round in no time, or while time
   does not matter. The search, which meets the states of a cycle in any order, need not have gone round it. *)
let cycle_of_returns t =
  let successors = Array.make t.count [] in
  let follow n edge = successors.(n) <- edge :: successors.(n) in
  for n = t.count - 1 downto 0 do
    match t.nodes.(n) with { move = Some move; parent; _ } -> follow parent (n, move) | { move = None; _ } -> ()
  done;
  List.iter (fun (n, m, move) -> follow n (m, move)) t.returns;
  let passes_time around = List.exists (fun (n, _) -> Zone.latest_date t.nodes.(n).zone = None) around in
  let concerns = Looks.at_one_moment t.options.program in
  (* A cycle that agrees with itself has, of each two looks that do not agree, one at most. *)
  let rec possible known =
    let admitted (_, (_, move)) = Looks.admits concerns known (looks_of move) in
    let kept n edges = List.filter (fun edge -> admitted (n, edge)) edges in
    match cycle_in t.count (Array.mapi kept successors) with
    | Some around when not (passes_time around) -> (
        match Looks.compare_all concerns known (List.map (fun (_, move) -> looks_of move) around) with
        | Agree -> Some around
        | Ask (one, other) -> (
            match possible one with Some around -> Some around | None -> possible other))
    | found -> found
  in
  match possible Looks.nothing with
  | None -> None
  | Some _ when t.reduced -> raise Broken
  | Some around ->
    (* The states on it once more, as a run of the search. *)
    let first = fst (List.hd around) in
    let rec again parent = function
      | [ (_, Step { step; _ }) ] ->
        let in_no_time = Zone.latest_date t.nodes.(first).zone <> None in
        Some { from = first; last = parent; back = step; in_no_time }
      | (_, move) :: ((n, _) :: _ as rest) -> again (add t { (t.nodes.(n)) with parent; move = Some move }) rest
      | [ (_, Rest _) ] | [] -> None
    in
    again first around

let cycle t =
  if t.cycle = None && t.returns <> [] then t.cycle <- cycle_of_returns t;
  t.cycle
let stuck t = t.stuck
let unknown t = List.rev t.unknown

let path t n =
  let rec back found n =
    match t.nodes.(n) with
    | { move = Some move; parent; place = { state; items; execution; _ }; _ } ->
      back ({ move; into = state; items; execution } :: found) parent
    | { move = None; _ } -> found
  in
  back [] n

let arrival_by t e =
  let { state; items; execution; _ } : Zone_node.t = t.nodes.(e.target).place in
  { move = e.by; into = state; items; execution }

(* The state that is followed instead of state [n], if another one is. *)
let rec standing_for t n = match t.nodes.(n).turn with Included_in m -> standing_for t m | To_come | Taken -> n

let edges t =
  let standing e = { e with target = standing_for t e.target } in
  Option.map (fun edges -> List.rev (List.rev_map standing edges)) t.edges

let along t edges = List.map (arrival_by t) edges

let ends t =
  let ended n =
    let { place; zone; _ } = t.nodes.(n) in
    if Configuration.has_ended place.state.configuration then Some (n, date t zone) else None
  in
  List.filter_map ended (List.init t.count Fun.id)

let count t = t.count
let state t n = t.nodes.(n).place.state

let course t = t.course

type stay = { may_do : Dolphin_scenario.Battery.doing list; most : int option; waited : float }

let stay t n =
  let of_course c =
    let { place; zone; _ } = t.nodes.(n) in
    { may_do = Course.may_do c place.state; most = snd (since t place zone);
      waited = Course.waited c place.state }
  in
  Option.map of_course t.course

let arrival t n ({ step; begun; _ } : Zone_node.arrow) =
  let execution = Zone_node.execution_after t.places t.nodes.(n).place step.next in
  { move = Step { step; begun; last = None; items = [] }; into = step.next; items = []; execution }

let deadlines t =
  let missed site =
    let path (date, n, arrow) = (date, path t n @ [ arrival t n arrow ]) in
    (site, Option.map path (Hashtbl.find_opt t.missed site))
  in
  List.rev_map missed !(t.deadlines)

let start t = t.start
let is_reduced t = t.reduced
let places t = t.places
let successors t = Zone_node.successors t.places
