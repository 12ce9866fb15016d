open Dolphin_semantics
open Dolphin_checker
open Dolphin_ltl

type lasso = { stem : int list; around : int list }

type verdict =
  | Ends
  | Goes_on of lasso
  | Spins of lasso
  | By_design of { repeats : Core.site list; retries : Core.site list; left_by : string list }
  | Unsure

(* {1 The part of the graph in which tasks execute} *)

(* Where it is decided by readings how a run goes on: in this code, or among the guards of this component; in the
   script, by this comparison or sensor. *)
type choice = Code_at of Core.site | Guards_of of int list | Looking_at of string

(* Of a step, by its number: see {!Space.possible}. It [is_strongly_owed] if strong
   fairness owes it. [renews] is the places of the
   repeats that begin a round, [valuation] that of a formula's propositions, [looks] its assumptions. A step that
   [chooses] is possible with any readings; others wait. [choices] is the choices that it makes. Of the assumptions, by
   number: it [meets] those whose readings its looks allow; others are [against] it, if another step of the choice meets
   them. *)
type edge = {
  into : int;
  by : int;
  is_strongly_owed : bool;
  is_event : bool;
  rounds : Task_rules.round list;
  renews : int list list;
  valuation : int;
  looks : Looks.t;
  chooses : bool;
  choices : choice list;
  meets : (int * choice) list;
  against : (int * choice) list;
}

(* The steps that are possible and that no vehicle or person may prevent by staying away, those that strong fairness
   owes, and the successors of the followed ones. At a node that [waits] time may pass: each step that needs no event
   may be impossible there. *)
type node = { possible : int list; strongly_owed : int list; waits : bool; edges : edge list }

type t = {
  program : Core.program;
  graph : State_graph.t;
  numbers : (int list, int) Hashtbl.t;
  steps : (int, Space.possible) Hashtbl.t;  (* by number *)
  nodes : (int, node) Hashtbl.t;  (* by state *)
  on_cycle : (int -> bool) Lazy.t;  (* whether a state is on a cycle of the graph: no component has others *)
  automaton : Monitor.t option;  (* then what is searched is pairs: see {!Formulas} below *)
  moments : Moments.t;  (* nodes with moments, which have numbers below 0 *)
  is_open : bool;  (* whether sensors, or the date, may show several things *)
  whole : bool;  (* whether no steps are left out *)
  assumed : World.assumption list array;
  strong : bool;  (* whether fairness is strong *)
  mutable active : int list;  (* the assumptions that count, by number *)
  mutable unsure : bool;  (* whether omitted steps may matter to the property *)
}

(* The graph without what {!node} adds: it costs much less. *)
let arrivals_of graph ~sets is_in : unit Cycles.graph =
  let arrivals i = List.map (fun (a : State_graph.arrival) -> (a.into, ())) (State_graph.arrivals graph i) in
  { successors = arrivals; sets; is_in }

let create ?automaton ?(whole = true) ?(assumed = []) ?(strong = false) program graph =
  let reads = program.Core.reads_sensors || program.reads_now in
  let is_open = reads && World.is_open (Space.world (State_graph.system graph)) in
  let assumed = Array.of_list (if is_open then assumed else []) in
  let active = List.init (Array.length assumed) Fun.id in
  let tick = State_graph.ticker graph "looking for cycles" in
  { program; graph; is_open; whole; assumed; strong; active; unsure = false; numbers = Hashtbl.create 100;
    on_cycle = lazy (Cycles.on_cycles ~tick (arrivals_of graph ~sets:0 (fun _ _ -> false)) [ 0 ]);
    steps = Hashtbl.create 100; nodes = Hashtbl.create 1_000; automaton; moments = Moments.create () }

let number t (p : Space.possible) =
  let id = p.at @ (-2 :: p.name) in
  match Hashtbl.find_opt t.numbers id with
  | Some n -> n
  | None ->
    let n = Hashtbl.length t.numbers in
    Hashtbl.add t.numbers id n;
    Hashtbl.add t.steps n p;
    n

(* The places, among the [layers], of the rounds that begin: no two of these are equal. *)
let places_of rounds layers =
  let place (again : Residual.again) =
    let is_it (_, (again' : Residual.again)) =
      again'.site = again.site && (again'.each == again.each || Residual.equal again'.each again.each)
    in
    Option.map fst (List.find_opt is_it layers)
  in
  (* A task that restarts waits for vehicles in between: none of its steps stays possible. *)
  let of_round = function Task_rules.Endless again | Asked again -> place again | Retried _ -> None in
  List.filter_map of_round rounds

(* The recruited vehicle was present before. *)
let is_event (p : Space.possible) =
  match p.step.event with Some (Recruited _) | None -> false | Some _ -> true

(* Recruiting is one step, whichever vehicle comes. It need not be taken where all who may come may stay away. *)
let certain t key found =
  let system = State_graph.system t.graph and recruits = Hashtbl.create 4 in
  let note (k, (p : Space.possible)) =
    match p.step.event with Some (Recruited (_, v)) -> Hashtbl.add recruits k v | Some _ | None -> ()
  in
  List.iter note found;
  let is_certain (k, _) =
    match Hashtbl.find_all recruits k with [] -> true | vs -> not (Space.may_all_stay_away system key vs)
  in
  List.sort_uniq Int.compare (List.map fst (List.filter is_certain found))

let chooses (Task_rules.Step { offer; _ }) =
  match offer with
  | Start _ | Perform _ | Guard_either _ | Measure _ | Make _ | End_of _ | Expiry_of _ | Answer_to _ -> true
  | Check _ | Guard_values _ | Guard_false _ | Allocate _ | Recruit_for _ -> false

(* Strong fairness owes ends of plans, and steps that only an event can prevent: a guard may be prevented by another one
   that is chosen. *)
let is_strongly_owed (p : Space.possible) =
  match p.step.event with None -> chooses p.step.source | Some (Vehicle_done _) -> true | Some _ -> false

(* {1 Choices} *)

let concerns t = Looks.at_one_moment t.program

let choices_of_task t (p : Space.possible) looks =
  let (Task_rules.Step { offer; _ }) = p.step.source in
  let code (c : Core.closure) = [ Code_at c.lambda.lambda_site ] in
  if not (t.is_open && Looks.is_look (concerns t) looks) then []
  else
    match offer, p.name with
    | Perform c, _ | Guard_either c, _ | Measure c, _ | Make (c, _, _), _ -> code c
    | (Check _ | Guard_values _ | Guard_false _), family :: local :: _ -> [ Guards_of [ family; local ] ]
    | _, _ -> []

let choices_of_script t looks =
  let subject : World.assumption -> choice option = function
    | Claim (text, _) -> Some (Looking_at text)
    | Sensed (s, v, _) -> Some (Looking_at (World.spell s v))
    | Placed (v, _) -> Some (Looking_at (Printf.sprintf "position(%s)" v))
    | Late _ | Missing _ -> None
  in
  if not (t.is_open && Looks.is_look (concerns t) looks) then []
  else List.sort_uniq Stdlib.compare (List.filter_map subject (Looks.readings (concerns t) looks))

(* The assumptions that a step with these looks meets, and the others about its sensors, each with its choice. *)
let weighed t (choices, looks) =
  let at_choices numbers = List.concat_map (fun i -> List.map (fun c -> (i, c)) choices) numbers in
  let concerns = concerns t in
  let is_about i = choices <> [] && Looks.are_at concerns t.assumed.(i) looks in
  let about = List.filter is_about (List.init (Array.length t.assumed) Fun.id) in
  let meets, others = List.partition (fun i -> Looks.may_show concerns t.assumed.(i) looks) about in
  (at_choices meets, at_choices others)

(* The edges of one state. [ways] is the choices and looks of all its steps: those that violate no formula any more
   are no edges, but a run may take them. *)
let with_assumptions t ways edges =
  if Array.length t.assumed = 0 then edges
  else
    let met = List.concat_map (fun way -> fst (weighed t way)) ways in
    let weigh e =
      let meets, others = weighed t (e.choices, e.looks) in
      { e with meets; against = List.filter (fun pair -> List.mem pair met) others }
    in
    List.map weigh edges

let examined t i =
  State_graph.visiting t.graph i (fun key arrived visitor ->
      let found = ref [] and owed = ref [] and edges = ref [] and waits = ref true and ways = ref [] in
      let possible (p : Space.possible) =
        if p.step.event = None && (chooses p.step.source || not p.depends) then waits := false;
        if is_strongly_owed p then owed := number t p :: !owed;
        found := (number t p, p) :: !found
      in
      let taken (p : Space.possible) rounds layers looks =
        let by = number t p and is_event = is_event p and renews = places_of rounds layers in
        let chooses = chooses p.step.source in
        let choices = choices_of_task t p looks in
        ways := (choices, looks) :: !ways;
        let arrive into valuation =
          let e =
            { into; by; is_strongly_owed = is_strongly_owed p; is_event; rounds; renews; valuation; looks; chooses;
              choices; meets = []; against = [] } in
          edges := e :: !edges
        in
        arrived := arrive
      in
      Space.examine (State_graph.system t.graph) key ~possible ~taken visitor;
      let edges = with_assumptions t !ways (List.rev !edges) in
      { possible = certain t key !found; strongly_owed = List.sort_uniq Int.compare !owed; waits = !waits; edges })

(* The number of no step of a task. *)
let of_script = -1

let scripted t i =
  State_graph.visiting t.graph i (fun key arrived visitor ->
      let edges = ref [] and ways = ref [] in
      let taken (next : Transition.t) =
        let is_event = Looks.is_event next and looks = Looks.of_transition next in
        let choices = choices_of_script t looks in
        ways := (choices, looks) :: !ways;
        let arrive into valuation =
          let e =
            { into; by = of_script; is_strongly_owed = false; is_event; rounds = []; renews = []; valuation; looks;
              chooses = true; choices; meets = []; against = [] } in
          edges := e :: !edges
        in
        arrived := arrive
      in
      Space.examine_script (State_graph.system t.graph) key ~taken visitor;
      let waits =
        match (fst (State_graph.state t.graph i)).control with
        | Waiting _ -> true
        | Script _ | Executing _ | Ended _ -> false
      in
      { possible = []; strongly_owed = []; waits; edges = with_assumptions t !ways (List.rev !edges) })

let state_executes t i = Space.executes (State_graph.system t.graph) (State_graph.load t.graph i).(0)

let node_of_state t i =
  match Hashtbl.find_opt t.nodes i with
  | Some node -> node
  | None ->
    let node = if state_executes t i then examined t i else scripted t i in
    Hashtbl.add t.nodes i node;
    node

(* {1 Pairs}

   With a formula, a node is the pair of a state and a state of the automaton in its set, as one number: only within
   one component of the automaton, as no cycle leaves it. *)

let pairs_after automaton q into valuation =
  let n = Monitor.automaton_states automaton and component = Monitor.component automaton q in
  let is_inside q' = component >= 0 && Monitor.component automaton q' = component in
  List.map (fun q' -> (into * n) + q') (List.filter is_inside (Monitor.after automaton q valuation))

let pairs_of t automaton states =
  let n = Monitor.automaton_states automaton in
  let of_state i =
    let is_inside q = Monitor.component automaton q >= 0 in
    List.map (fun q -> (i * n) + q) (List.filter is_inside (Monitor.members automaton (State_graph.set t.graph i)))
  in
  List.concat_map of_state states

let without_moment t i = if i >= 0 then i else (Moments.find t.moments i).i

let split t i =
  let i = without_moment t i in
  match t.automaton with
  | None -> (i, 0)
  | Some automaton ->
    let n = Monitor.automaton_states automaton in
    (i / n, i mod n)

let state_of t i = fst (split t i)

let node_of_pair t i =
  match t.automaton with
  | None -> node_of_state t i
  | Some automaton ->
    let state, q = split t i in
    let found = node_of_state t state in
    let paired e = List.map (fun into -> { e with into }) (pairs_after automaton q e.into e.valuation) in
    { found with edges = List.concat_map paired found.edges }

(* Before an event, and where all waits for readings, time may pass. *)
let may_pass node e = e.is_event || node.waits

let node t i =
  if i >= 0 then node_of_pair t i
  else
    let { Moments.component; i; moment } = Moments.find t.moments i in
    let found = node_of_pair t i in
    let at e =
      let into = Moments.number t.moments component e.into in
      List.map (fun moment -> { e with into = into moment })
        (Moments.after component ~time:(may_pass found e) moment e.looks)
    in
    { found with edges = List.concat_map at found.edges }

let executes t i = state_executes t (state_of t i)

(* The requirements on a cycle. *)
let acceptance t =
  match t.automaton with
  | None -> []
  | Some automaton ->
    let set k i = Monitor.is_in automaton (snd (split t i)) k in
    List.init (Monitor.acceptance_sets automaton) set

let is_accepting t members = List.for_all (fun is_in -> List.exists is_in members) (acceptance t)

(* A part of the graph: its nodes and edges. *)
type part = { within : int -> bool; keeps : edge -> bool }

let is_on_cycle t i = Lazy.force t.on_cycle (state_of t i)

let successors t part i =
  List.filter (fun e -> part.keeps e && part.within e.into && is_on_cycle t e.into) (node t i).edges
let of_tasks t keeps = { within = executes t; keeps }

(* {1 Components} *)

type place = { mutable low : int; at : int; mutable rest : edge list }

(* The strongly connected components with a cycle, in the reachable part of a subgraph (Tarjan). *)
let components t ~tick part states =
  let places = Hashtbl.create 1_000 and on_path = Hashtbl.create 100 in
  let path = Stack.create () and frames = Stack.create () and found = ref [] in
  let enter i =
    tick ();
    let place = { low = Hashtbl.length places; at = Hashtbl.length places; rest = successors t part i } in
    Hashtbl.add places i place;
    Hashtbl.add on_path i ();
    Stack.push i path;
    Stack.push i frames
  in
  let rec members i acc =
    let j = Stack.pop path in
    Hashtbl.remove on_path j;
    if j = i then j :: acc else members i (j :: acc)
  in
  let leave i place =
    ignore (Stack.pop frames);
    (match Stack.top_opt frames with
     | Some above ->
       let above = Hashtbl.find places above in
       above.low <- min above.low place.low
     | None -> ());
    if place.low = place.at then
      match members i [] with
      | [ j ] when not (List.exists (fun e -> e.into = j) (successors t part j)) -> ()
      | component -> found := component :: !found
  in
  let step i =
    let place = Hashtbl.find places i in
    match place.rest with
    | [] -> leave i place
    | e :: rest -> (
        place.rest <- rest;
        match Hashtbl.find_opt places e.into with
        | None -> enter e.into
        | Some other -> if Hashtbl.mem on_path e.into then place.low <- min place.low other.at)
  in
  let explore i =
    if not (Hashtbl.mem places i) then begin
      enter i;
      while not (Stack.is_empty frames) do
        step (Stack.top frames)
      done
    end
  in
  List.iter explore (List.filter (is_on_cycle t) states);
  !found

let inside members =
  let set = Hashtbl.create 100 in
  List.iter (fun i -> Hashtbl.replace set i ()) members;
  Hashtbl.mem set

let kept_inside t part members =
  let is_in = inside members in
  fun i -> List.filter (fun e -> is_in e.into) (successors t part i)

let edges_inside t part members = List.concat_map (kept_inside t part members) members

(* {1 Looks}

   Components whose [looks] all agree, each with its part of the graph. If two of them do not agree, a run that agrees
   has one or the other, so the component is divided. *)

let rec agreeing t ~tick ~looks concerns known part states =
  let divided members =
    let part = { part with within = inside members } in
    match Looks.compare_all concerns known (List.map looks (edges_inside t part members)) with
    | Agree -> [ (part, members) ]
    | Ask (one, other) ->
      let under known =
        let keeps e = part.keeps e && Looks.admits concerns known (looks e) in
        agreeing t ~tick ~looks concerns known { part with keeps } members
      in
      under one @ under other
  in
  let found = components t ~tick part states in
  if t.is_open then List.concat_map divided found else List.map (fun members -> (part, members)) found

let at_one_moment t ~tick part states =
  agreeing t ~tick ~looks:(fun e -> e.looks) (Looks.at_one_moment t.program) Looks.nothing part states

(* A step that waits for a date that has passed waits in vain: only what chooses is left to go on in another way. *)
let choice e = if e.chooses then e.looks else Looks.none

let of_one_date t ~tick part states =
  agreeing t ~tick ~looks:choice (Looks.of_date t.program) Looks.nothing part states

(* Once time has passed, sensors may show something else. *)
let passes_time t part members =
  List.exists (fun i -> (node t i).waits) members
  || List.exists (fun e -> e.is_event) (edges_inside t part members)

(* Those that a run may repeat without end. If steps were left out, so may be the node at which time passes. *)
let lasting t ~tick part states =
  let with_time (part, members) =
    if (not t.is_open) || passes_time t part members then [ (part, members) ]
    else
      match at_one_moment t ~tick part members with
      | [] ->
        if not t.whole then t.unsure <- true;
        []
      | found -> found
  in
  List.concat_map with_time (of_one_date t ~tick part states)

(* {1 Assumptions on readings}

   A run around a component meets an assumption at a choice if it takes a step there that meets it, or none that is
   against it. *)

let unmet t edges =
  let pairs f = List.sort_uniq Stdlib.compare (List.concat_map f edges) in
  let met = pairs (fun e -> e.meets) in
  let is_unmet ((i, _) as pair) = List.mem i t.active && not (List.mem pair met) in
  List.filter is_unmet (pairs (fun e -> e.against))

(* With strong fairness, the steps that are owed at some of these nodes. *)
let strongly_owed t members =
  if t.strong then List.sort_uniq Int.compare (List.concat_map (fun i -> (node t i).strongly_owed) members) else []

let takes k e = e.is_strongly_owed && e.by = k

(* Those of them that are taken at none. *)
let missed t edges members = List.filter (fun k -> not (List.exists (takes k) edges)) (strongly_owed t members)

(* More nodes with moments are not searched. *)
let most_moments = 100_000

(* Those that a run may repeat without end so that it meets the assumptions: without the steps against those that the
   whole does not meet, for no part of it does; and so without the nodes at which a step is owed by strong fairness that
   is not taken; it may be taken there, if steps were left out. *)
let rec recurring_at_any_moment t ~tick part states =
  let divided (part, members) =
    let edges = edges_inside t part members in
    match unmet t edges, missed t edges members with
    | [], [] -> [ (part, members) ]
    | pairs, steps ->
      if steps <> [] && not t.whole then t.unsure <- true;
      let keeps e = part.keeps e && not (List.exists (fun pair -> List.mem pair pairs) e.against) in
      let within i = part.within i && not (List.exists (fun k -> List.mem k (node t i).strongly_owed) steps) in
      recurring_at_any_moment t ~tick { within; keeps } (List.filter within members)
  in
  List.concat_map divided (lasting t ~tick part states)

(* Symmetry may exchange the vehicles of readings. *)
let is_symmetric t = Space.exchanges (State_graph.system t.graph)

(* The same without the runs on which a look contradicts another one though no time has passed. Steps that were left
   out may let time pass in between. *)
let recurring t ~tick part states =
  let concerns = Looks.at_one_moment t.program in
  let refined (part, members) =
    let looks = List.map (fun e -> e.looks) (edges_inside t part members) in
    if (not t.is_open) || Looks.agree concerns looks then [ (part, members) ]
    else begin
      let component = Moments.component (Looks.contested concerns looks) in
      let is_in = inside members in
      let within i =
        let i = without_moment t i in
        is_in i && part.within i
      in
      let tick () =
        tick ();
        if Moments.count component > most_moments then raise_notrace Exit
      in
      let states = List.map (fun i -> Moments.number t.moments component i Looks.beginning) members in
      match recurring_at_any_moment t ~tick { part with within } states with
      | [] ->
        if (not t.whole) || is_symmetric t then t.unsure <- true;
        []
      | found -> found
      | exception Exit -> [ (part, members) ]
    end
  in
  List.concat_map refined (recurring_at_any_moment t ~tick part states)

(* Those that a run may repeat in no time. *)
let spinning t ~tick part states =
  let keeps e = part.keeps e && not e.is_event in
  at_one_moment t ~tick { part with keeps } states

(* {1 Fairness} *)

type fairness = Fair | Perhaps | Unfair

let rec begins_with prefix xs =
  match prefix, xs with
  | [], _ -> true
  | x :: prefix, y :: xs -> Int.equal x y && begins_with prefix xs
  | _ :: _, [] -> false

(* The steps that are possible in every state of the component, and in no round that ends there: a fair run around takes
   each of them. *)
let owed t edges members =
  let renewed = List.concat_map (fun i -> List.concat_map (fun e -> e.renews) (edges i)) members in
  let renewed = List.sort_uniq Stdlib.compare renewed in
  let is_renewed k =
    let at = (Hashtbl.find t.steps k).at in
    List.exists (fun repeat -> begins_with (repeat @ [ Space.inside ]) at) renewed
  in
  let common n i = List.filter (fun k -> List.mem k (node t i).possible) n in
  match members with
  | [] -> []
  | first :: rest -> List.fold_left common (List.filter (fun k -> not (is_renewed k)) (node t first).possible) rest

let fairness t part members =
  let edges = kept_inside t part members in
  let taken = Hashtbl.create 100 in
  List.iter (fun i -> List.iter (fun e -> Hashtbl.replace taken e.by ()) (edges i)) members;
  match List.filter (fun k -> not (Hashtbl.mem taken k)) (owed t edges members) with
  | [] -> Fair
  | missing -> if List.exists (fun k -> (Hashtbl.find t.steps k).stays) missing then Unfair else Perhaps

(* {1 Cycles to be shown} *)

let cycle_graph edges : edge Cycles.graph =
  { successors = (fun i -> List.map (fun e -> (e.into, e)) (edges i)); sets = 0; is_in = (fun _ _ -> false) }

let rec last = function [ x ] -> x | _ :: rest -> last rest | [] -> invalid_arg "Fair_cycles.last"

(* A way around the component that takes all steps that are owed, as far as the component does, comes to a state in
   which another is not possible, and meets what it has to: its first node, by default the least, and its edges. If
   looks do not agree, time passes on it. *)
let around ?start t part members =
  let edges = kept_inside t part members in
  let earlier i j = if without_moment t i <= without_moment t j then i else j in
  let start = match start with Some start -> start | None -> List.fold_left earlier (List.hd members) members in
  let graph = cycle_graph edges in
  let to_goal from goal =
    if goal from then []
    else
      match Cycles.way graph ~within:(fun _ -> true) ~goal (graph.successors from) with
      | Some way -> List.map snd way
      | None -> invalid_arg "Fair_cycles.around: no component"
  in
  let is_taken k = List.exists (fun i -> List.exists (fun e -> e.by = k) (edges i)) members in
  let owed = List.filter is_taken (owed t edges members) in
  let go_on (from, cycle) is_wanted =
    let takes i = List.find_opt is_wanted (edges i) in
    let way = to_goal from (fun i -> takes i <> None) in
    let at = match way with [] -> from | way -> (last way).into in
    match takes at with
    | Some e -> (e.into, cycle @ way @ [ e ])
    | None -> invalid_arg "Fair_cycles.around: a step that is not taken"
  in
  let meet (from, cycle) goal =
    let way = to_goal from goal in
    ((match way with [] -> from | way -> (last way).into), cycle @ way)
  in
  let elsewhere k i = not (List.mem k (node t i).possible) in
  let everywhere k = List.for_all (fun i -> List.mem k (node t i).possible) members in
  let sometimes = List.filter (fun k -> not (everywhere k)) (node t start).possible in
  let looks () = List.map (fun e -> e.looks) (edges_inside t part members) in
  let agree () = Looks.agree (Looks.at_one_moment t.program) (looks ()) in
  let waits i = (node t i).waits in
  let to_wait, to_take =
    if (not t.is_open) || agree () then ([], [])
    else if List.exists waits members then ([ waits ], [])
    else ([], [ (fun e -> e.is_event) ])
  in
  let all = List.concat_map edges members in
  let meets (pair : int * choice) e = List.mem pair e.meets in
  let is_met ((i, _) as pair) = List.mem i t.active && List.exists (meets pair) all in
  let against = List.sort_uniq Stdlib.compare (List.concat_map (fun e -> e.against) all) in
  let to_meet = List.map meets (List.filter is_met against) in
  let goals = List.map elsewhere sometimes @ acceptance t @ to_wait in
  let to_take_strongly = List.filter (fun takes -> List.exists takes all) (List.map takes (strongly_owed t members)) in
  let wanted = List.map (fun k e -> e.by = k) owed @ to_take @ to_take_strongly @ to_meet in
  let from, cycle = List.fold_left meet (List.fold_left go_on (start, []) wanted) goals in
  let back =
    if from = start && cycle <> [] then []
    else
      match Cycles.way graph ~within:(fun _ -> true) ~goal:(Int.equal start) (graph.successors from) with
      | Some way -> List.map snd way
      | None -> invalid_arg "Fair_cycles.around: no way back"
  in
  (start, cycle @ back)

let lasso ?start t part members =
  let start, cycle = around ?start t part members in
  let states = List.map (without_moment t) (start :: List.map (fun e -> e.into) cycle) in
  { stem = State_graph.path t.graph (without_moment t start); around = states }

(* {1 Cycles of the script} *)

(* Whether no look contradicts another one around these [hops] without any time in between: with the looks of each
   round before, which two rounds show. *)
let is_of_moments t states hops =
  let concerns = Looks.at_one_moment t.program in
  let contested = Looks.contested concerns (List.concat_map (List.map (fun e -> e.looks)) hops) in
  let component = Moments.component contested in
  let hop moments (i, edges) =
    let after moment e = Moments.after component ~time:(may_pass (node_of_state t i) e) moment e.looks in
    List.concat_map (fun moment -> List.concat_map (after moment) edges) moments |> List.sort_uniq Looks.compare_moments
  in
  let round moments = List.fold_left hop moments (List.combine states hops) in
  round (round [ Looks.beginning ]) <> []

(* Whether some run repeats these states without end, and meets the assumptions. *)
let may_last t states =
  let hop (i, j) = List.filter (fun e -> e.into = j) (node_of_state t i).edges in
  let rec pairs = function i :: (j :: _ as rest) -> (i, j) :: pairs rest | [ _ ] | [] -> [] in
  let hops = List.map hop (pairs states) in
  let agree concerns looks = Looks.agree concerns (List.map (List.concat_map looks) hops) in
  let passes_time =
    List.exists (List.exists (fun e -> e.is_event)) hops || List.exists (fun i -> (node_of_state t i).waits) states in
  (* One of several steps between two states may be taken now, and another the next time. *)
  if passes_time then
    unmet t (List.concat hops) = []
    && missed t (List.concat hops) states = []
    && agree (Looks.of_date t.program) choice
    && is_of_moments t (List.filteri (fun k _ -> k < List.length hops) states) hops
  else agree (Looks.at_one_moment t.program) (fun e -> e.looks)

let whole = { within = (fun _ -> true); keeps = (fun _ -> true) }

(* The least node of the script among these. *)
let script_node t members = List.find_opt (fun i -> not (executes t i)) (List.sort Int.compare members)

let script_cycle_that_lasts t ~tick =
  let shown (part, members) = Option.map (fun start -> lasso ~start t part members) (script_node t members) in
  let all = State_graph.all t.graph in
  match List.find_map shown (recurring t ~tick whole all) with
  | None when t.active <> [] || t.strong -> List.find_map shown (spinning t ~tick whole all)
  | found -> found

let first_script_cycle t ~tick =
  if not (Space.may_cycle_in_script (State_graph.system t.graph)) then None
  else
    let graph = arrivals_of t.graph ~sets:1 (fun i _ -> not (executes t i)) in
    let lasso component =
      let rec exact i = if Cycles.mem component i && not (executes t i) then i else exact (i + 1) in
      let start = exact (Cycles.first component) in
      let within i = Cycles.mem component i in
      match Cycles.way graph ~within ~goal:(Int.equal start) (graph.successors start) with
      | Some way -> { stem = State_graph.path t.graph start; around = start :: List.map fst way }
      | None -> invalid_arg "Fair_cycles.script_cycle: a state that is on no cycle"
    in
    Option.map lasso (Cycles.find ~tick graph [ 0 ])

(* With symmetry of vehicles a name need not be the same vehicle's in all states of the script. *)
let script_cycle t ~tick =
  match first_script_cycle t ~tick with
  | Some { around; _ } when (t.is_open || t.strong) && not (may_last t around) ->
    if Space.has_vehicle_symmetry (State_graph.system t.graph) then begin
      t.unsure <- true;
      None
    end
    else script_cycle_that_lasts t ~tick
  | found -> found

let may_go_round program graph (lasso : lasso) =
  let t = create program graph in
  (not t.is_open) || may_last t lasso.around

(* {1 Verdicts} *)

let is_endless e = List.exists (function Task_rules.Endless _ | Retried _ -> true | Asked _ -> false) e.rounds

(* [done_too]: they go on while something fails, so that it is done may end them. *)
let left_by t members ~done_too =
  let is_in = inside members in
  let told e =
    let p = Hashtbl.find t.steps e.by in
    match p.step.source, p.step.event with
    | Step { offer = End_of (task, v); _ }, Some (Vehicle_failed (_, why)) ->
      Some (Printf.sprintf "%s failing on %s: %s" task.name v why)
    | Step { offer = End_of (task, v); _ }, Some (Vehicle_done _) when done_too ->
      Some (Printf.sprintf "%s being done on %s" task.name v)
    | Step { offer = Check c; _ }, _ | Step { offer = Guard_false c; _ }, _ | Step { offer = Guard_either c; _ }, _ ->
      let at = Fault.location t.program (Fault.make c.lambda.lambda_site "") in
      Option.map (Format.asprintf "the condition at %a" Dolphin_syntax.Location.pp) at
    | Step _, _ -> None
  in
  let leaving i = List.filter (fun e -> not (is_in e.into)) (node t i).edges in
  let inputs =
    match members with
    | [] -> []
    | i :: _ -> Space.inputs_at (State_graph.system t.graph) (snd (State_graph.state t.graph (state_of t i)))
  in
  let inputs = List.map (Printf.sprintf "the input '%s'") inputs in
  List.sort_uniq String.compare (inputs @ List.filter_map told (List.concat_map leaving members))

let by_design t members =
  let members = List.sort_uniq Int.compare (List.map (without_moment t) members) in
  let edges = kept_inside t (of_tasks t (fun _ -> true)) members in
  let endless = function Task_rules.Endless again -> Some again.site | Asked _ | Retried _ -> None in
  let retried = function Task_rules.Retried site -> Some site | Endless _ | Asked _ -> None in
  let rounds = List.concat_map (fun e -> e.rounds) (List.concat_map edges members) in
  let found kind = List.sort_uniq Int.compare (List.filter_map kind rounds) in
  let retries = found retried in
  (found endless, retries, left_by t members ~done_too:(retries <> []))

let verdict t =
  let graph = t.graph and whole = t.whole in
  t.unsure <- false;
  let tick = State_graph.ticker graph "looking for cycles" in
  let states = List.filter (executes t) (State_graph.all graph) in
  let of_kind keeps =
    let judged (part, members) =
      match fairness t part members with
      | Perhaps when whole -> (Unfair, (part, members))
      | fairness -> (fairness, (part, members))
    in
    List.map judged (recurring t ~tick (of_tasks t keeps) states)
  in
  let without_endless e = not (is_endless e) and all _ = true in
  match script_cycle t ~tick, spinning t ~tick (of_tasks t all) states with
  | Some lasso, _ -> Goes_on lasso
  | None, (part, members) :: _ -> Spins (lasso t part members)
  | None, [] -> (
      let asked = of_kind without_endless in
      match List.assoc_opt Fair asked with
      | Some (part, members) -> Goes_on (lasso t part members)
      | None when List.mem_assoc Perhaps asked || t.unsure -> Unsure
      | None -> (
          let endless = of_kind all in
          let design (fairness, (_, members)) = if fairness = Fair then Some (by_design t members) else None in
          let designs = List.filter_map design endless in
          match designs with
          | _ when t.unsure -> Unsure
          | [] -> if List.mem_assoc Perhaps endless then Unsure else Ends
          | designs ->
            let together f = List.sort_uniq Stdlib.compare (List.concat_map f designs) in
            let repeats = together (fun (repeats, _, _) -> repeats) in
            let retries = together (fun (_, retries, _) -> retries) in
            By_design { repeats; retries; left_by = together (fun (_, _, left_by) -> left_by) }))

(* {1 Verdicts under assumptions} *)

let under t active =
  t.active <- active;
  verdict t

(* How good news it is. *)
let rank = function Ends -> 2 | By_design _ -> 1 | Goes_on _ | Spins _ | Unsure -> 0

(* Of the assumptions [active], which lead to [found], those without which it would be worse. *)
let needed t active found =
  let drop kept i =
    let rest = List.filter (fun j -> j <> i) kept in
    if rank (under t rest) >= rank found then rest else kept
  in
  List.fold_left drop active active

type judgement = { verdict : verdict; needs : World.assumption list list }

let judge ?(strong = false) program graph ~all:whole ~assumed =
  let t = create ~whole ~assumed ~strong program graph in
  let all = t.active in
  match under t [] with
  | (Ends | Goes_on _ | By_design _) when strong && is_symmetric t -> { verdict = Unsure; needs = [] }
  | (Ends | Spins _ | Unsure) as verdict -> { verdict; needs = [] }
  | (Goes_on _ | By_design _) as verdict when all = [] -> { verdict; needs = [] }
  | Goes_on _ when is_symmetric t -> { verdict = Unsure; needs = [] }
  | By_design _ as verdict when is_symmetric t -> { verdict; needs = [] }
  | (Goes_on _ | By_design _) as plain -> (
      match under t all with
      | (Ends | By_design _) as found when rank found > rank plain ->
        let needs = needed t all found in
        { verdict = under t needs; needs = List.map (Array.get t.assumed) needs }
      | By_design _ -> { verdict = plain; needs = [] }
      | (Ends | Goes_on _ | Spins _ | Unsure) as verdict -> { verdict; needs = [] })

(* {1 Assumptions that would help} *)

let most_candidates = 8

(* The readings of other ways to go, at the choices of the steps of endless runs. *)
let candidates t ~tick =
  let other_ways i e =
    let shares e' = List.exists (fun c -> List.mem c e'.choices) e.choices in
    let ways = List.filter shares (node_of_state t (state_of t i)).edges in
    let readings = List.concat_map (fun e' -> Looks.readings (concerns t) e'.looks) ways in
    List.filter (fun a -> not (Looks.may_show (concerns t) [ a ] e.looks)) readings
  in
  let of_part (part, members) =
    let at i = List.concat_map (other_ways i) (kept_inside t part members i) in
    if fairness t part members = Unfair then [] else List.concat_map at members
  in
  let found = List.concat_map of_part (recurring t ~tick whole (State_graph.all t.graph)) in
  List.sort_uniq World.compare_assumption found

type help = { recurring : World.assumption list list; strong : bool }
type advice = Help of help | No_help | In_more_states

(* As few of the readings [found] as are known to do. *)
let helpful_readings program graph ~whole ~assumed ~strong found =
  let given = List.length assumed in
  let t = create ~whole ~strong ~assumed:(assumed @ found) program graph in
  let always = List.init given Fun.id and further = List.mapi (fun i _ -> given + i) found in
  let ends active = under t active = Ends in
  let chosen =
    match List.find_opt (fun i -> ends (always @ [ i ])) further with
    | Some i -> Some [ i ]
    | None when ends (always @ further) ->
      let drop kept i =
        let rest = List.filter (fun j -> j <> i) kept in
        if ends (always @ rest) then rest else kept
      in
      Some (List.fold_left drop further further)
    | None -> None
  in
  Option.map (fun chosen -> { recurring = List.map (Array.get t.assumed) chosen; strong }) chosen

let helpful ?(strong = false) program graph ~all:whole ~assumed =
  let t = create ~whole ~assumed ~strong program graph in
  let tick = State_graph.ticker graph "looking for assumptions" in
  let found =
    if t.is_open && not (is_symmetric t) then List.map (fun a -> [ a ]) (candidates t ~tick) else [] in
  let readings ~strong =
    if found = [] || List.length found > most_candidates then None
    else helpful_readings program graph ~whole ~assumed ~strong found
  in
  let strongly () =
    let t = create ~whole ~assumed ~strong:true program graph in
    under t t.active
  in
  let or_in_more_states = function
    | Some help -> Help help
    | None when whole -> No_help
    | None -> In_more_states
  in
  if is_symmetric t then In_more_states
  else if strong then or_in_more_states (readings ~strong)
  else
    match readings ~strong:false with
    | Some help -> Help help
    | None -> (
        match strongly () with
        | Ends -> Help { recurring = []; strong = true }
        | Spins _ -> No_help
        | (Goes_on _ | By_design _) when not t.is_open -> No_help
        | Goes_on _ | By_design _ | Unsure -> or_in_more_states (readings ~strong:true))

(* {1 Formulas} *)

let shown ?start t part members =
  let start, cycle = around ?start t part members in
  (fst (split t start), List.map (fun e -> (fst (split t e.into), e.valuation)) cycle)

(* An accepting cycle through the script, in which no step stays possible all around. *)
let accepting_through_script t automaton ~parts ~tick =
  if not (Space.may_cycle_in_script (State_graph.system t.graph)) then None
  else if t.is_open || t.strong then
    let found (part, members) =
      if is_accepting t members then
        Option.map (fun start -> shown ~start t part members) (script_node t members)
      else None
    in
    List.find_map found (parts whole (pairs_of t automaton (State_graph.all t.graph)))
  else
    let successors i =
      let state, q = split t i in
      let after (a : State_graph.arrival) =
        List.map (fun into -> (into, a.valuation)) (pairs_after automaton q a.into a.valuation) in
      List.concat_map after (State_graph.arrivals t.graph state)
    in
    let sets = Monitor.acceptance_sets automaton in
    let is_in i k = if k = sets then not (executes t i) else Monitor.is_in automaton (snd (split t i)) k in
    let graph : int Cycles.graph = { successors; sets = sets + 1; is_in } in
    let starts = List.filter (fun i -> not (state_executes t i)) (State_graph.all t.graph) in
    let shown component =
      let start = Cycles.first component in
      let cycle = Cycles.around graph component start in
      (fst (split t start), List.map (fun (i, valuation) -> (fst (split t i), valuation)) cycle)
    in
    Option.map shown (Cycles.find ~tick graph (pairs_of t automaton starts))

let violation_under t automaton ~fair active : Breadth_first.violation option =
  t.active <- active;
  let graph = t.graph in
  let tick = State_graph.ticker graph "checking formulas" in
  let pairs = pairs_of t automaton (List.filter (state_executes t) (State_graph.all graph)) in
  let tasks = of_tasks t (fun _ -> true) in
  let accepting found is_fair =
    let is_it (part, members) = is_accepting t members && is_fair part members in
    Option.map (fun (part, members) -> shown t part members) (List.find_opt is_it found)
  in
  let is_fair part members = (not fair) || fairness t part members = Fair in
  let parts part states = if fair then recurring t ~tick part states else lasting t ~tick part states in
  let ways =
    [ (fun () -> accepting_through_script t automaton ~parts ~tick);
      (fun () ->
         if active = [] && not t.strong then None
         else accepting_through_script t automaton ~parts:(spinning t ~tick) ~tick);
      (fun () -> accepting (spinning t ~tick tasks pairs) (fun _ _ -> true));
      (fun () -> accepting (parts tasks pairs) is_fair) ]
  in
  let rec first = function
    | [] -> None
    | way :: ways -> (match way () with Some found -> Some found | None -> first ways)
  in
  let of_found (start, cycle) = Breadth_first.Around { stem = State_graph.path graph start; cycle } in
  Option.map of_found (first ways)

let violation ?(strong = false) program graph automaton ~fair ~assumed =
  let t = create ~automaton ~assumed:(if fair then assumed else []) ~strong program graph in
  let all = t.active in
  let holds active = violation_under t automaton ~fair active = None in
  let drop kept i =
    let rest = List.filter (fun j -> j <> i) kept in
    if holds rest then rest else kept
  in
  match violation_under t automaton ~fair all with
  | Some _ as violation -> (violation, [])
  | None -> (None, List.map (Array.get t.assumed) (List.fold_left drop all all))
