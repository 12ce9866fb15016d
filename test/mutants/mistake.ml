type t = { name : string; file : string; find : string; replace : string; noticed_by : string }

(* The mistakes in [file] that [noticed_by] must notice, each with the text that it replaces and the replacement. *)
let in_file file ~noticed_by mistakes =
  List.map (fun (name, find, replace) -> { name; file; find; replace; noticed_by }) mistakes

let footprint =
  in_file "lib/explore/order/footprint.ml" ~noticed_by:"reduction/test_traps"
    [
      ( "to dismiss concerns nobody else",
        {|  | Builtin Dismiss, _ -> { breaking with claims = All; frees = All; looks = true }|},
        {|  | Builtin Dismiss, _ -> breaking|} );
      ( "posts do not conflict with tests",
        {|
      || Pairs.meet f.posts f'.tests|},
        {||} );
      ( "patterns test nothing",
        {|  | Builtin (Values_of | Poll []), [ e ] -> (|},
        {|  | Builtin Values_of, _ -> breaking
  | Builtin (Poll []), [ e ] -> (|} );
      ( "keys that are computed touch nothing",
        {|Option.fold ~none:anything ~some:f (pairs|},
        {|Option.fold ~none:breaking ~some:f (pairs|} );
      ( "tests do not conflict with posts",
        {|
      || Pairs.meet f.tests f'.posts|},
        {||} );
      ( "takes do not conflict with needs",
        {|
      || Pairs.meet f.takes f'.needs|},
        {||} );
      ( "takes do not conflict with tests",
        {|
      || Pairs.meet f.takes f'.tests|},
        {||} );
      ( "needs do not conflict with takes",
        {|
      || Pairs.meet f.needs f'.takes|},
        {||} );
      ( "tests do not conflict with takes",
        {|
      || Pairs.meet f.tests f'.takes|},
        {||} );
      ( "a post frees no guard",
        {|(not possible) && Pairs.meet f.needs f'.posts|},
        {|(not possible) && false && Pairs.meet f.needs f'.posts|} );
      ( "the order of pairs never matters",
        {|
      || Pairs.meet f.queues f'.queues|},
        {||} );
      ( "reads do not conflict with writes",
        {|share f.reads f'.writes || |},
        {||} );
      ( "writes do not conflict with reads",
        {|share f.writes f'.reads || |},
        {||} );
      ( "writes do not conflict with writes",
        {| || share f.writes f'.writes|},
        {||} );
      ( "the code in a variable touches nothing",
        {|      | Make_closure _, _ | _, Some (Closure _) -> breaking
      | _, _ -> anything)
  | (Method _|},
        {|      | Make_closure _, _ | _, Some (Closure _) -> breaking
      | _, _ -> breaking)
  | (Method _|} );
      ( "a consume is no test",
        {|{ empty with takes = pairs; tests = pairs }|},
        {|{ empty with takes = pairs; needs = pairs }|} );
      ( "functions that are called touch nothing",
        {|union breaking (expression code [] seen lambda.code)|},
        {|ignore (expression code [] seen lambda.code); breaking|} );
    ]

let step_footprints =
  in_file "lib/explore/order/step_footprints.ml" ~noticed_by:"reduction/test_traps"
    [
      ( "a computed duration is never faulty",
        {|| Measure d, _ -> union breaking (Footprint.of_code c.code d)|},
        {|| Measure d, _ -> Footprint.of_code c.code d|} );
      ( "handlers touch nothing",
        {|and handled c (f : Footprint.t) handler = if f.breaks then|},
        {|and handled c (f : Footprint.t) handler = if f.breaks && f.halts then|} );
      ( "what is tried again touches nothing",
        {|  | Some (task, request) -> all [ handling c handler; recovering c handler.code request; of_shared c task ]|},
        {|  | Some (task, request) -> if task == task then handling c handler else recovering c handler.code request|} );
      ( "ends of tasks leave no trace outside",
        {|let remembered = Environment.endings_remember c.options in|},
        {|let remembered = false && Environment.endings_remember c.options in|} );
      ( "branches beside the one that runs first do not matter",
        {| && not (clash before || clash after)|},
        {| && (ignore (clash before || clash after); true)|} );
      ( "the body of a branch that runs first may do anything",
        {|is_settled c b.body && only_takes f'|},
        {|(is_settled c b.body || true) && only_takes f'|} );
      ( "nothing follows a nest",
        {|with_handlers (union f (following c contexts)) :: futures|},
        {|with_handlers f :: (ignore (following c contexts); futures)|} );
      ( "no error cuts off a nest",
        {|futures.(level).breaks && List.exists ignores (handlers_of c contexts)|},
        {|futures.(level).breaks && futures.(level).halts && List.exists ignores (handlers_of c contexts)|} );
    ]

let order_of_recruits =
  in_file "lib/explore/order/step_footprints.ml" ~noticed_by:"reduction/test_recruits"
    [
      ( "two may recruit one vehicle in either order",
        {|Some (Recruited (_, v)) -> { Footprint.empty with claims = Footprint.these [ v ] }|},
        {|Some (Recruited _) -> Footprint.empty|} );
      ( "who waits for a vehicle takes none from others",
        {|{ breaking with claims = Footprint.all_vehicles; frees = Footprint.all_vehicles } in
  union any|},
        {|breaking in
  union any|} );
      ( "who was recruited is not free later",
        {|union { Footprint.empty with frees = freed c [ v ] } (future c r)|},
        {|(ignore v; future c r)|} );
      ( "who is asked for comes some time",
        {|Faults.is_possible faults.join || Faults.is_possible faults.loss|},
        {|Faults.is_possible faults.join && false|} );
    ]
  @ in_file "lib/explore/order/step_footprints.ml" ~noticed_by:"reduction/test_traps"
    [
      ( "a branch that runs first may hold a vehicle",
        {|  | Sequence (r, _) | All_of (Some r, _) -> first_branches c around r|},
        {|  | Sequence (r, _) | All_of (Some r, _) -> first_branches c around r
  | Hold (_, r) when not (is_settled c r) -> first_branches c around r|} );
      ( "whom a nest has recruited is not free after it",
        {|    | In_recruited v -> { Footprint.empty with frees = freed c [ v ] }|},
        {|    | In_recruited _ -> Footprint.empty|} );
      ( "whatever is allocated is the component's own",
        {|if is_own request then breaking|},
        {|if is_own request || request.allowed <> None then breaking|} );
      ( "a branch that runs first may be in a nest that holds a vehicle",
        {|if c.leaks || List.exists (List.exists holds) nests then|},
        {|if c.leaks || List.exists (List.exists holds) nests && false then|} );
    ]

let stubborn =
  in_file "lib/explore/order/stubborn.ml" ~noticed_by:"reduction/test_traps"
    [
      ( "nothing becomes possible later",
        {|Footprint.conflict ~possible:(surely_moves t x k) own f|},
        {|Footprint.conflict ~possible:(surely_moves t x k || true) own f|} );
      ( "what is cut off need not be taken along",
        {|exists_step t x cut && not (Footprint.leaves_no_trace (future t y x))|},
        {|exists_step t x cut && false && not (Footprint.leaves_no_trace (future t y x))|} );
      ( "a key may cut off others",
        {|List.exists (is_cut_off own.place other.place) moves
  |||},
        {|(List.exists (is_cut_off own.place other.place) moves && false)
  |||} );
      ( "a key may be cut off",
        {||| ((not (Footprint.leaves_no_trace f)) && may_cut_off t y x)|},
        {||| ((not (Footprint.leaves_no_trace f)) && may_cut_off t y x && false)|} );
      ( "a key may end a nest",
        {||| (List.exists ends_nest moves &&|},
        {||| (List.exists ends_nest moves && false &&|} );
      ( "an end of the run depends on nothing",
        {|ends.(k) && (not (Footprint.reads_nothing footprints.(k))) && may_end t x k|},
        {|ends.(k) && (not (Footprint.reads_nothing footprints.(k))) && may_end t x k && false|} );
      ( "a branch that runs first may be cut off",
        {| && not (may_cut_off t y x))
  in|},
        {| && not (may_cut_off t y x && false))
  in|} );
      ( "what stands beside a branch that runs first does not matter",
        {|(not (Footprint.conflict ~possible:true f (future t y x))) && not|},
        {|(not (Footprint.conflict ~possible:true f (future t y x)) || true) && not|} );
      ( "inputs make no difference to what is chosen",
        {|exists_taken (meets_inputs t) taken|},
        {|exists_taken (meets_inputs t) taken && false|} );
    ]

let inputs =
  in_file "lib/environment/environment.ml" ~noticed_by:"explore/test_verdicts"
    [
      ( "each input is certain",
        {|List.exists (fun (_, input) -> input.certain) (pending|},
        {|List.exists (fun (_, input) -> input.certain || true) (pending|} );
      ( "an input comes again and again",
        {|sent e i < input.times in|},
        {|min 0 (sent e i) < input.times in|} );
    ]
  @ in_file "lib/semantics/rules/transition.ml" ~noticed_by:"semantics/test_rules"
    [ ( "whoever waits gets no inputs",
        {|  | Input (k, x), (Script _ | Waiting _ | Executing _) when|},
        {|  | Input (k, x), (Script _ | Executing _) when|} ) ]

let automorphism =
  in_file "lib/explore/symmetry/automorphism.ml" ~noticed_by:"reduction/test_traps"
    [
      ( "an automorphism need not fix N",
        {|| Some map when fixes map ->|},
        {|| Some map when fixes map || true ->|} );
      ( "computed pairs may be renamed",
        {|not (Footprint.Pairs.meet (Footprint.Pairs.singleton pair) fixed)|},
        {|not (Footprint.Pairs.meet (Footprint.Pairs.singleton pair) fixed) || true|} );
      ( "handlers that read the error may be exchanged",
        {|not (Skeleton.of_code (Task_isomorphism.skeletons context) ~handler code).unclear|},
        {|not (Skeleton.of_code (Task_isomorphism.skeletons context) ~handler code).unclear || true|} );
    ]

let task_isomorphism =
  in_file "lib/explore/symmetry/task_isomorphism.ml" ~noticed_by:"reduction/test_traps"
    [
      ( "how a plan ends does not matter",
        {|| Environment.Succeeds -> "s"
  | May_fail -> "m"
  | Fails -> "f"|},
        {|| Environment.Succeeds | May_fail | Fails -> "s"|} );
    ]

let task_groups =
  in_file "lib/explore/symmetry/task_groups.ml" ~noticed_by:"reduction/test_traps"
    [
      ( "the group of an execution need not fix its N",
        {|if not (Option.fold ~none:true ~some:fixes group.group) then|},
        {|if not (Option.fold ~none:true ~some:fixes group.group || true) then|} );
      ( "each N has a group of its own",
        {|let e = { Symmetry.task = r; constant = constant footprint shared } in|},
        {|let constant = ignore (constant footprint shared); shared in
    let e = { Symmetry.task = r; constant } in|} );
      ( "handlers have other orbits in other tasks",
        {|known = members | None -> true|},
        {|known = members || true | None -> true|} );
    ]

let quotient =
  in_file "lib/explore/symmetry/quotient.ml" ~noticed_by:"reduction/test_traps"
    [
      ( "what images start is not reached",
        {|    reach_orbit t g r;
|},
        {|    if false then reach_orbit t g r;
|} );
    ]

let expansion =
  in_file "lib/explore/steps/expansion.ml" ~noticed_by:"reduction/test_traps"
    [
      ( "the script goes on from one image only",
        {|List.iter image (Task_group.orbit_of_shared g shared)|},
        {|image (List.hd (Task_group.orbit_of_shared g shared))|} );
    ]

let portable =
  in_file "lib/explore/encoding/portable.ml" ~noticed_by:"explore/test_successors"
    [
      ( "states do not say what is shared",
        {|    put 1 (shared_name t above);|},
        {|    put 1 (shared_name t 0);|} );
      ( "what a process met first is what stands there",
        {|  memoised members name read|},
        {|  memoised members 0 read|} );
      ( "no part is told",
        {|  if is_new then t.news <- text :: t.news;|},
        {|  ignore (is_new && t.news = [ text ]);|} );
      ( "two parts may have one name",
        {|  | Some _ -> raise Ambiguous|},
        {|  | Some _ -> (name, false)|} );
    ]
  @ in_file "lib/app/exploration/successors.ml" ~noticed_by:"explore/test_successors"
    [
      ( "a state has the parent of the one after it",
        {|while answer.until.(!source) <= i do|},
        {|while answer.until.(!source) < i do|} );
      ( "any state is the least",
        {|Some known when String.compare known digest <= 0 -> ()|},
        {|Some _ when String.length digest >= 0 -> ()|} );
      ( "what was reached before fields grew is in the old encoding",
        {|    t.reached <- States.rewrite t.reached ~words:(Space.words t.space) renewed;|},
        {|    t.reached <- States.rewrite t.reached ~words:(Space.words t.space) (fun old fresh ->
        if States.count t.reached < 0 then renewed old fresh
        else Array.blit old 0 fresh 0 (Array.length old));|} );
    ]

let vehicle_orbits =
  in_file "lib/semantics/terms/world.ml" ~noticed_by:"reduction/test_told_apart"
    [
      ( "what vehicles measure does not matter",
        {|Core.Battery :: Speed :: Connected :: measured)|},
        {|Core.Battery :: Speed :: Connected :: List.filter (fun _ -> false) measured)|} );
      ( "links do not matter",
        {|Core.Battery :: Speed :: Connected :: measured)|},
        {|Core.Battery :: Speed :: measured)|} );
    ]
  @ in_file "lib/explore/symmetry/vehicle_orbits.ml" ~noticed_by:"reduction/test_told_apart"
    [
      ( "places do not matter",
        {|if_read flow.places|},
        {|if_read (flow.places && flow.sensors && flow.names <> None)|} );
      ( "what sensors show does not matter",
        {|if_read flow.sensors|},
        {|if_read (flow.places && flow.sensors && flow.names <> None)|} );
      ( "vehicles named in texts are exchanged",
        {|if is_odd || List.mem s.id flow.texts then|},
        {|if is_odd then|} );
      ( "payloads do not matter",
        {|((s.kind, s.payload, s.connected, may_be_late),|},
        {|((s.kind, s.connected, may_be_late),|} );
      ( "it does not matter who may be late",
        {|Faults.is_possible options.faults.join && options.may_be_late s.id in|},
        {|Faults.is_possible options.faults.join && false && options.may_be_late s.id in|} );
    ]

let canonical_vehicles =
  in_file "lib/explore/symmetry/canonical_vehicles.ml" ~noticed_by:"reduction/test_told_apart"
    [
      ( "others between those of an orbit do not matter",
        {|if last > List.length (by_orbit r accepted) then|},
        {|if last > List.length (by_orbit r accepted) && false then|} );
      ( "known vehicles are as free ones",
        {|| v :: _ :: _ as vs when is_movable r v && List.exists is_known vs ->|},
        {|| v :: _ :: _ as vs when is_movable r v && List.exists is_known vs && false ->|} );
      ( "a computed id breaks nothing",
        {|if is_movable r id then fix r [ id ]|},
        {|if is_movable r id && false then fix r [ id ]|} );
      ( "answers may read variables",
        {|if not (List.for_all is_harmless|},
        {|if false && not (List.for_all is_harmless|} );
      ( "a supplier may name vehicles of an orbit",
        {|with [] -> () | vs -> fix r vs|},
        {|with [] -> () | vs -> if false then fix r vs|} );
      ( "computed plans end in the same way",
        {|then split r ending;|},
        {|then (if false then split r ending);|} );
      ( "plans of tasks that are made end in the same way",
        {|List.iter (check_plan r) (String.concat|},
        {|if false then List.iter (check_plan r) (String.concat|} );
      ( "tasks that are made have only plans that the fleet names",
        {|(String.concat "" ("other" :: plans) :: plans)|},
        {|plans|} );
    ]
  @ in_file "lib/explore/encoding/encoding.ml" ~noticed_by:"reduction/test_told_apart"
    [
      ( "where a task begins, names and what nothing reads are kept",
        {|  let (c : Configuration.t), outside = t.canonical c outside in
  match|},
        {|  let (c : Configuration.t), outside =
    match c.Configuration.control with Executing _ -> (c, outside) | _ -> t.canonical c outside
  in
  match|} );
    ]
  @ in_file "lib/explore/verdict/replay.ml" ~noticed_by:"reduction/test_told_apart"
    [
      ( "a run that is shown begins a task by the fleet's names",
        {|if found = [] then|},
        {|if found = [] && false then|} );
    ]

let bitstate =
  in_file "lib/checker/search/bitstate.ml" ~noticed_by:"checker/test_search"
    [
      ("what is left out is not counted", {|t.omitted +. (p /. (1. -. p))|}, {|t.omitted +. (0. *. p)|});
      ("one bit tells a state", {|number = hashes || (is_set|}, {|number = 1 || (is_set|});
      ("hashes begin with a small number", {|t.first <- 0x2D35_8DCC_AA6C_78A5|}, {|t.first <- 1|});
    ]
  @ in_file "lib/checker/search/trail.ml" ~noticed_by:"checker/test_search"
    [ ("the path keeps what was left", {|entry.depth >= depth ->|}, {|entry.depth > depth ->|}) ]
  @ in_file "lib/checker/search/depth_first.ml" ~noticed_by:"checker/test_search"
    [
      ("a search by hashes is said to be of all states", {|raise (Limits.Stop Hashed)|}, {|ignore Limits.Hashed|});
      ("hashed steps to known states close no cycle", {|then look_for_cycle t deep key hash|}, {|then ignore look_for_cycle|});
    ]
  @ in_file "lib/explore/steps/space.ml" ~noticed_by:"explore/test_bitstate"
    [ ("components are not hashed", {|f (Layout.local layout key i)|}, {|ignore (Layout.local layout key i)|}) ]
  @ in_file "lib/checker/search/depth_first.ml" ~noticed_by:"explore/test_bitstate"
    [ ("what waits keeps its encoding", {|Trail.rewrite deep.trail renewed;|}, {|ignore Trail.rewrite;|}) ]

let workers =
  in_file "lib/checker/search/together.ml" ~noticed_by:"checker/test_search"
    [
      ("the transitions of workers are not counted", {|t.transitions <- t.transitions + transitions;|},
       {|ignore (transitions : int);|});
    ]
  @ in_file "lib/checker/store/shared_states.ml" ~noticed_by:"checker/test_search"
    [
      ("a run of parents begins with the one before", {|Array1.unsafe_set t.runs (at + 1) parent|},
       {|Array1.unsafe_set t.runs (at + 1) (parent - 1)|});
    ]
  @ in_file "lib/checker/store/shared_states.ml" ~noticed_by:"checker/test_states"
    [
      ("states that move go to their places from the first on", {|Int.compare first' first|}, {|Int.compare first first'|});
    ]
  @ in_file "lib/checker/store/numbering.ml" ~noticed_by:"explore/test_workers"
    [ ("each process gives numbers as they come", {|if t.is_closed then raise_notrace Closed|}, {|ignore t.is_closed|}) ]
  @ in_file "lib/checker/search/team.ml" ~noticed_by:"explore/test_workers"
    [ ("what others have learnt is not learnt before", {|      catch_up t ~words f;
      let key|}, {|      t.known <- get t logged;
      let key|}) ]
  @ in_file "lib/checker/search/together.ml" ~noticed_by:"explore/test_workers"
    [
      ("the deadlock of a worker is lost", {|t.deadlock <- first_of t t.deadlock resting;|}, {|ignore resting;|});
      ("what workers find beside states is lost", {|S.add_findings t.system found;|}, {|ignore found;|});
      ("numbers that were given in vain fit", {|| exception S.Outgrown -> outgrow t);|}, {|| exception S.Outgrown -> ());|});
    ]
  @ in_file "lib/checker/search/together.ml" ~noticed_by:"explore/test_temporal"
    [
      ("the violation of a worker is lost", {|t.violation <- first_of t t.violation violating;|}, {|ignore violating;|});
      ("what a worker learns is learnt with no set of the monitor", {|      t.key.(0) <- t.key.(0) lxor t.from;
|}, {||});
    ]
  @ in_file "lib/explore/verdict/invariant.ml" ~noticed_by:"explore/test_workers"
    [ ("what workers see of invariants is lost", {|-1 -> () | i -> t.broken <- Some i|}, {|i -> ignore i|}) ]
  @ in_file "lib/ltl/monitor.ml" ~noticed_by:"explore/test_temporal"
    [ ("each process numbers sets as they come", {|    give ();|}, {|    ignore give;|}) ]
  @ in_file "lib/explore/encoding/layouts.ml" ~noticed_by:"explore/test_counts"
    [ ("spare bits are worth a word", {|lay_out_all t widths <= words || spare = 0|},
       {|lay_out_all t widths <= words + 1 || spare = 0|}) ]

let disk =
  in_file "lib/checker/store/on_disk.ml" ~noticed_by:"checker/test_states"
    [
      ("what is known is added again", {|Bytes.unsafe_set known i '\001'|}, {|Bytes.unsafe_set known i '\000'|});
      ("parents on disk are counted from where memory began", {|(t.first_parent + Packed.parent|}, {|(0 + Packed.parent|});
      ("one batch of a window is not looked at", {|first < t.window_states then|}, {|first < t.window_states - 200 then|});
      ("an index of fewer states is used again", {|Some (states, index) when states = t.count -> index|},
       {|Some (states, index) when states <= t.count -> index|});
    ]
  @ in_file "lib/checker/store/disk_index.ml" ~noticed_by:"checker/test_states"
    [ ("the index ends at the end of a window", {|if k = n then `Further|}, {|if k = n then `Found (-1)|}) ]
  @ in_file "lib/checker/search/search_state.ml" ~noticed_by:"checker/test_search"
    [ ("with a disk, memory is a bound nevertheless", {|Limits.Stop Memory when t.spill <> None ->
      spill t;
      look_around|}, {|Limits.Stop Memory when t.spill = Some "" ->
      spill t;
      look_around|}) ]

let name_flow =
  in_file "lib/explore/symmetry/name_flow.ml" ~noticed_by:"reduction/test_told_apart"
    [
      ( "names may be put into texts",
        {|  if has vehicles k then uses_name w at;
  if has reading k|},
        {|  if has vehicles k && has map k && has code k then uses_name w at;
  if has reading k|} );
      ( "the property id is no name",
        {|    let k = value_of x in
    if has vehicles k then uses_name w at;
    k lor text
|},
        {|    let k = value_of x in
    if has vehicles k && has map k && has code k then uses_name w at;
    k lor text
|} );
      ( "vehicles may be keys of maps",
        {|if List.mem None keys && has vehicles k then uses_name w at;
    map|},
        {|if List.mem None keys && has vehicles k && has code k then uses_name w at;
    map|} );
      ( "methods that sort see no names",
        {|if has vehicles (k lor results) then uses_name w at;|},
        {|if has vehicles (k lor results) && has code k then uses_name w at;|} );
      ( "handlers may read the error",
        {|lambda.parameters > 0 -> uses_name w e.site; text|},
        {|lambda.parameters > 0 -> text|} );
      ( "code that makes a task gets no vehicles",
        {|(fun _ -> taken)|},
        {|(fun _ -> taken land text)|} );
    ]

let liveness =
  in_file "lib/explore/symmetry/liveness.ml" ~noticed_by:"reduction/test_told_apart"
    [
      ( "code that is called reads no variables",
        {|if may_call operation then Variables.union called live else live|},
        {|if may_call operation && false then Variables.union called live else live|} );
    ]

let recruiting =
  in_file "lib/explore/symmetry/canonical_vehicles.ml" ~noticed_by:"reduction/test_told_apart"
    [
      ( "who is known is recruited as anybody is",
        {|n = 0 || is_known v || String.equal|},
        {|n = 0 || String.equal|} );
      ( "a computed id to recruit breaks nothing",
        {|  check_id r asked;
  let orbit|},
        {|  ignore asked;
  let orbit|} );
    ]
  @ in_file "lib/explore/steps/recruiting.ml" ~noticed_by:"reduction/test_told_apart"
    [
      ( "what waits for the task knows nobody",
        {|union (union (outside_of_task t x) components) nests|},
        {|(ignore outside_of_task; union (union Vehicle_set.empty components) nests)|} );
      ( "what stands beside knows nobody",
        {|union (union (outside_of_task t x) components) nests|},
        {|(ignore components; union (outside_of_task t x) nests)|} );
      ( "what stands around knows nobody",
        {|union (union (outside_of_task t x) components) nests|},
        {|(ignore nests; union (outside_of_task t x) components)|} );
      ( "recruits side by side have the same vehicles in all orders",
        {|let turn = Hashtbl.length t.turns in|},
        {|let turn = 0 * Hashtbl.length t.turns in|} );
    ]
  @ in_file "lib/explore/symmetry/later_picks.ml" ~noticed_by:"reduction/test_told_apart"
    [
      ( "who is lost does not stay away",
        {|if may_follow program || program.recruits then|},
        {|if may_follow program || (program.recruits && false) then|} );
    ]

let later_picks =
  in_file "lib/explore/symmetry/later_picks.ml" ~noticed_by:"environment/test_environment"
    [
      ( "nothing is looked for after a task",
        {|    if next then note ();
|},
        {||} );
      ( "functions look for nobody",
        {|    next || called.picks
|},
        {|    next
|} );
      ( "functions execute nothing",
        {|if called.executes && (next || called.picks) then note ();|},
        {|if called.executes && false then note ();|} );
      ( "a loop has one turn",
        {|    round (round false)
|},
        {|    round false
|} );
      ( "a range is gone through once",
        {|{ exits with next = round (round false) }|},
        {|{ exits with next = round false }|} );
      ( "nothing follows a break",
        {|  | Break -> exits.break
|},
        {|  | Break -> ignore exits.break; false
|} );
    ]

let environment =
  in_file "lib/environment/environment.ml" ~noticed_by:"environment/test_environment"
    [
      ( "late vehicles are remembered for join=1 only",
        {|match options.faults.join with At_most _ -> noted | Never | Any_number -> [] in|},
        {|match options.faults.join with At_most 1 -> noted | At_most _ | Never | Any_number -> [] in|} );
      ( "failures are not counted",
        {|failed { heard with failed = e.failed + 1 }|},
        {|failed { heard with failed = e.failed }|} );
      ( "losses are not counted",
        {|ends @ lost { e with losses = e.losses + 1 }|},
        {|ends @ lost { e with losses = e.losses }|} );
      ( "who is heard of stays lost",
        {|let heard = if is_lost then { e with lost = less v e.lost } else e in|},
        {|let heard = if is_lost then { e with lost = add v (less v e.lost) } else e in|} );
      ( "a loss of a lost vehicle is counted",
        {|| _ when is_lost -> ends @ lost e|},
        {|| _ when is_lost && options.faults.loss = Any_number -> ends @ lost e|} );
      ( "a question gets its first answers only",
        {|min (times name counted) (n - 1)|},
        {|min (min 0 (times name counted)) (n - 1)|} );
      ( "no answer is refused twice",
        {|times prompt before.asked < List.length (options.answers prompt) - 1|},
        {|times prompt before.asked < List.length (options.answers prompt) - 2|} );
      ( "each way in which too few come is followed",
        {|      not seen
|},
        {|      true
|} );
    ]

let picks =
  in_file "lib/environment/environment.ml" ~noticed_by:"reduction/test_picks"
    [
      ( "which of those alike was late is not remembered",
        {|let alike = match options.faults.join with At_most _ -> None | Never|},
        {|let alike = match options.faults.join with At_most 0 -> None | At_most _ | Never|} );
      ( "one too few of those alike are looked at",
        {|      before >= n
|},
        {|      before >= n - 1
|} );
    ]

let attendance =
  in_file "lib/environment/attendance.ml" ~noticed_by:"environment/test_environment"
    [
      ( "lost vehicles are always there",
        {|let for_nothing = List.filter is_always company.silent @ known in|},
        {|let for_nothing = known in|} );
      ( "one too many must be missing",
        {|let least = List.length company.always - (n - 1) in|},
        {|let least = List.length company.always - (n - 2) in|} );
      ( "latecomers come in the order of the fleet",
        {|else if is_unsure company v then Some|},
        {|else if is_unsure company v && false then Some|} );
      ( "vehicles outside of the region are missed",
        {|always = ids (List.filter (is_seen_in List.for_all) states)|},
        {|always = ids (List.filter (is_seen_in List.exists) states)|} );
      ( "who was late before counts again",
        {|let is_new v = List.mem v unsure && not (List.mem v late) in|},
        {|let is_new v = List.mem v unsure in|} );
    ]

let task_rules =
  in_file "lib/semantics/rules/task_rules.ml" ~noticed_by:"semantics/test_rules"
    [
      ( "SEQ-2 starts no timers",
        {|timers = c.timers @ timers }
  in
  { (around ~next:(within (In_sequence rest))|},
        {|timers = c.timers @ List.filter (fun _ -> false) timers }
  in
  { (around ~next:(within (In_sequence rest))|} );
      ( "PAR-ERR does not cut the siblings",
        {|undoing (Cut (Branches.beside place)) (leave_parallel fault c)|},
        {|undoing (Cut (List.filter (fun _ -> false) (Branches.beside place))) (leave_parallel fault c)|} );
      ( "ALLOF-2 forgets the other branches",
        {|on_finished = (fun c -> add Rule.Allof_2 (Next (all_of None remaining)) c);|},
        {|on_finished = (fun c -> add Rule.Allof_2 (if List.length remaining > 5 then Next (all_of None remaining) else Finished) c);|} );
      ( "DURING-2 cancels no timer",
        {|on_finished = (fun c -> undoing (Cancel timer) (plain.on_finished c));|},
        {|on_finished = plain.on_finished;|} );
      ( "WATCH-IGNORE goes on with the error",
        {|let ignored () = change c.label Rule.Watch_ignore Finished in|},
        {|let ignored () = change c.label Rule.Watch_ignore (Failed fault) in|} );
      ( "WATCH-PROPAGATE ignores the error",
        {|let propagated fault = change c.label Rule.Watch_propagate (Failed fault) in|},
        {|let propagated (_ : Fault.t) = change c.label Rule.Watch_propagate Finished in|} );
      ( "WATCH-RETRY keeps nobody to watch",
        {|let outcome = Next (Watch (Unallocated { task; request }, handler)) in|},
        {|let outcome = Next (Unallocated { task; request }) in|} );
      ( "WATCH-INSTEAD goes no deeper",
        {|    let request = { request with depth = request.depth + 1 } in
    change label Rule.Watch_instead|},
        {|    change label Rule.Watch_instead|} );
      ( "REPEAT-2 sets no timers",
        {|{ change with outcome; timers = change.timers @ timers; rounds }|},
        {|{ change with outcome; timers = (if timers = [] then timers else change.timers); rounds }|} );
      ( "a round counts twice",
        {|repeat { again with left = Option.map pred again.left } round|},
        {|repeat { again with left = Option.map (fun n -> max 0 (n - 2)) again.left } round|} );
      ( "UNTIL-CUT leaves the body running",
        {|let cut change = undoing (Cut [ body ]) change in|},
        {|let cut change = if body = body then change else undoing (Cut [ body ]) change in|} );
      ( "UNTIL has no cut",
        {|    Some (alone (Check condition) continue)|},
        {|    if true then None else Some (alone (Check condition) continue)|} );
      ( "ASSURE-CUT ends as done",
        {|Rule.Assure_cut (Failed (Fault.make site (not_assured condition))))|},
        {|Rule.Assure_cut (if site < 0 then Failed (Fault.make site (not_assured condition)) else Finished))|}
      );
      ( "HOLD-1 forgets the held vehicles",
        {|around ~next:(within (Holding vs))|}, {|around ~next:(fun r -> ignore vs; r)|} );
      ( "a guard's values do not reach the code",
        {|(Made { made with given = taken deeds })|}, {|(Made { made with given = List.filteri (fun i _ -> i > 0) (taken deeds) })|}
      );
      ( "WITHIN-CUT ends as done",
        {|      | Fails site -> (Rule.Within_cut, Failed (Fault.make site (too_late duration)))|},
        {|      | Fails site -> (Rule.Within_cut, if site < 0 then Failed (Fault.make site (too_late duration)) else Finished)|}
      );
      ( "ONEOF-WHEN does not begin its body",
        {|  | body -> check b.guard ~holds:(fun label -> enter label enters around body) ~error|},
        {|  | body -> check b.guard ~holds:(fun label -> change label enters (Next (around body))) ~error|} );
      ( "DURING-SET sets no timer",
        {|Rule.During_set (Next next)) with timers = Wait (timer, Time seconds) :: timers }|},
        {|Rule.During_set (Next next)) with timers = List.tl (Wait (timer, Time seconds) :: timers) }|} );
      ( "CONFIRM-NO ends as done",
        {|Rule.Confirm_no (failed (Printf.sprintf "'%s' was answered no" prompt))|},
        {|Rule.Confirm_no (if site < 0 then failed prompt else Finished)|} );
      ( "ALLOF-WHEN takes away the branches before",
        {|let remaining = List.rev_append before after in
  choose b|},
        {|let remaining = List.rev_append (List.filter (fun _ -> false) before) after in
  choose b|} );
    ]

let local_step =
  in_file "lib/semantics/rules/local_step.ml" ~noticed_by:"semantics/test_rules"
    [
      ( "what is cut stays in A",
        {|let s = without_tasks (List.concat stopped) s in|},
        {|let s = without_tasks (List.filter (fun _ -> false) (List.concat stopped)) s in|} );
      ( "START does not enter A",
        {|{ s with allocation = Vehicle_map.add v p s.allocation } (continue ())|},
        {|{ s with allocation = Vehicle_map.remove v s.allocation } (continue ())|} );
      ( "a faulty handler ends the run",
        {|| Faulty (fault, said), _ when Fault.is_assertion fault ->|},
        {|| Faulty (fault, said), _ when Fault.is_assertion fault || true ->|} );
      ( "a handler that ignores propagates",
        {|(asked @ Run_code.effects deeds) (ignored ())|},
        {|(asked @ Run_code.effects deeds) (ignore ignored; propagated fault)|} );
    ]

let run_code =
  in_file "lib/semantics/rules/run_code.ml" ~noticed_by:"semantics/test_rules"
    [
      ( "code that is faulty has effects",
        {|    | Faulted fault -> Faulty (fault, said deeds)
|},
        {|    | Faulted fault ->
        if fault.message = "" then Faulty (fault, []) else Halts (fault.message, after context s, deeds)
|} );
      ( "messages of faulty code are lost",
        {|    | Faulted fault -> Faulty (fault, said deeds)|},
        {|    | Faulted fault -> Faulty (fault, List.filter (fun _ -> false) (said deeds))|} );
      ( "code changes no variables",
        {|{ s with bound = context.bound; store = context.store; tuples = context.tuples }|},
        {|{ s with bound = context.bound; tuples = context.tuples }|} );
    ]

let fences =
  in_file "lib/environment/scenario_world.ml" ~noticed_by:"time/test_recorded"
    [
      ( "no plan fails at a fence",
        {|| Succeeds when not (Fences.is_none fences && scenario.fences = []) -> May_fail|},
        {|| Succeeds when not (Fences.is_none fences && scenario.fences = []) -> Succeeds|} );
    ]
  @ in_file "lib/geo/fence.ml" ~noticed_by:"geo/test_fence"
    [
      ( "fences have no margin",
        {|Inside -> margin -. depth | Outside -> margin +. depth|},
        {|Inside -> (0. *. margin) -. depth | Outside -> (0. *. margin) +. depth|} );
      ( "fences inside keep out, and those outside in",
        {|Inside -> margin -. depth | Outside -> margin +. depth|},
        {|Inside -> margin +. depth | Outside -> margin -. depth|} );
      ( "circles are taken for their centres",
        {|  let margin = margin +. radius in|},
        {|  let margin = margin +. (0. *. radius) in|} );
      ( "beside others, circles are taken for their centres",
        {|let apart = piece.radius +. other.radius in|},
        {|let apart = 0. *. (piece.radius +. other.radius) in|} );
    ]
  @ in_file "lib/geo/rims.ml" ~noticed_by:"geo/test_fence"
    [
      ( "sides of rims are only in their lowest band",
        {|to band empty w.box.high do|},
        {|to band empty w.box.low do|} );
    ]
  @ in_file "lib/plans/plan_room.ml" ~noticed_by:"runtime/test_runtime"
    [
      ( "nobody looks at ways to plans",
        {|  | Some here -> parts_of_legs from (Inline_plan.path ~from:here ~speed:1. p)|},
        {|  | Some _ -> anywhere p|} );
    ]
  @ in_file "lib/plans/fences.ml" ~noticed_by:"runtime/test_runtime"
    [
      ( "the least of the least distances holds",
        {|when metres > least -> Some fence|},
        {|when metres < least -> Some fence|} );
    ]
  @ in_file "lib/explore/verdict/side_by_side.ml" ~noticed_by:"reduction/test_side_by_side"
    [
      ( "of three plans side by side, two are seen",
        {|    | one :: others -> List.iter (see_pair t one) others; each others|},
        {|    | one :: others -> List.iter (see_pair t one) others; each []|} );
    ]
  @ in_file "lib/explore/verdict/search.ml" ~noticed_by:"reduction/test_side_by_side"
    [
      ( "plans side by side are looked for by partial order",
        {|seen x { options with reduction = Whole } ~enough in|},
        {|seen x { options with reduction = Partial_order } ~enough in|} );
    ]
  @ in_file "lib/time/timed_analysis.ml" ~noticed_by:"time/test_exact"
    [
      ( "plans side by side are those by their order alone",
        {|      | candidates, None -> pairs |},
        {|      | candidates, None -> (fun (_, stopped) -> (candidates, stopped)) @@ pairs |} );
    ]
  @ in_file "lib/runtime/fence_guard.ml" ~noticed_by:"runtime/test_runtime"
    [
      ( "vehicles are kept to fences at the start only",
        {|      | Error why -> [ (v, "stopped: " ^ why) ]|},
        {|      | Error _ -> []|} );
    ]

let pick_rules =
  in_file "lib/semantics/rules/pick_rules.ml" ~noticed_by:"semantics/test_rules"
    [
      ( "a pick replaces B",
        {|{ s with bound = s.bound @ vs }|},
        {|{ s with bound = vs }|} );
    ]

let conclusion =
  in_file "lib/semantics/rules/conclusion.ml" ~noticed_by:"semantics/test_rules"
    [
      ( "an end stops nothing",
        {|before @ cut waits s @ released @|},
        {|before @ List.filter (function Effect.Stop _ -> false | _ -> true) (cut waits s) @ released @|} );
    ]

let recruits =
  in_file "lib/semantics/rules/task_rules.ml" ~noticed_by:"semantics/test_rules"
    [
      ( "who was recruited is not released at the end of its task",
        {|on_finished = (fun c -> undoing (Leave v) (plain.on_finished c));
    on_failed|},
        {|on_finished = plain.on_finished;
    on_failed|} );
      ( "who was recruited is not released by an error",
        {|on_failed = (fun fault c -> undoing (Leave v) (plain.on_failed fault c)) }|},
        {|on_failed = plain.on_failed }|} );
      ( "what a recruit makes may run on others",
        {|{ allowed = Some [ v ]; place; depth }|},
        {|{ allowed = None; place; depth }|} );
    ]
  @ in_file "lib/semantics/rules/local_step.ml" ~noticed_by:"semantics/test_rules"
    [
      ( "what is cut off releases nobody",
        {|List.map (fun v -> Effect.Stop v) stopped @ released recruits|},
        {|List.map (fun v -> Effect.Stop v) stopped @ List.filter (fun _ -> false) (released recruits)|} );
      ( "who was recruited is in no allocation",
        {|let bound = bound @ Residual.recruited_for around in|},
        {|let bound = bound @ List.filter (fun _ -> false) (Residual.recruited_for around) in|} );
    ]
  @ in_file "lib/semantics/rules/local_step.ml" ~noticed_by:"semantics/test_invariants"
    [
      ( "who was recruited is recruited again",
        {|if List.mem v (Residual.named_around surroundings) then|},
        {|if List.mem v (Residual.named_around surroundings) && false then|} );
    ]
  @ in_file "lib/semantics/rules/script_rules.ml" ~noticed_by:"semantics/test_invariants"
    [
      ( "an interruption does not release whom a task recruited",
        {|  | None -> Conclusion.ending ~waits ~recruits [ Interrupt ]|},
        {|  | None -> Conclusion.ending ~waits ~recruits:(List.filter (fun _ -> false) recruits) [ Interrupt ]|} );
    ]

let allocation =
  in_file "lib/semantics/rules/allocation.ml" ~noticed_by:"semantics/test_rules"
    [
      ( "tasks side by side share vehicles",
        {|Parallel (a, b) -> Disjoint (both|},
        {|Parallel (a, b) -> Shared (both|} );
    ]

let tuple_space =
  in_file "lib/semantics/terms/tuple_space.ml" ~noticed_by:"tuple_space/test_tuple_space"
    [
      ( "N is a set",
        {|Some (1 + Option.value count ~default:0)|},
        {|Some (max 1 (Option.value count ~default:0))|} );
      ( "equal values are different pairs",
        {|Counted (By_value.update (Value.normal x) more counts)|},
        {|Counted (By_value.update x more counts)|} );
      ( "a queue's values are found as they were written",
        {|if Value.compare x (Value.normal y) = 0|},
        {|if Value.compare x y = 0|} );
      ( "the newest pair is consumed",
        {|By_arrival.min_binding queue in|},
        {|By_arrival.max_binding queue in|} );
    ]

let task_rules_in_walks =
  in_file "lib/semantics/rules/task_rules.ml" ~noticed_by:"semantics/test_invariants"
    [
      ( "PAR-2 ends all",
        {|on_finished = (fun c -> add Rule.Par_2 (Next (without place)) c);|},
        {|on_finished = (fun c -> add Rule.Par_2 (if List.length (Branches.beside place) > 1 then Finished else Next (without place)) c);|} );
    ]

let local_step_in_walks =
  in_file "lib/semantics/rules/local_step.ml" ~noticed_by:"semantics/test_invariants"
    [
      ( "a false guard lets go on",
        {|if Value.truth x then go world ~asked:(Run_code.effects deeds) s (continue|},
        {|if Value.truth x || true then go world ~asked:(Run_code.effects deeds) s (continue|} );
      ( "DONE leaves the vehicle in A",
        {|go (without_tasks [ v ] s) (continue (Ok ()))|},
        {|go (without_tasks [] s) (continue (Ok ()))|} );
    ]

let sets_with_events =
  in_file "lib/explore/order/stubborn.ml" ~noticed_by:"reduction/test_traps"
    [
      ( "events come before what would spin",
        {|not (exists_taken (may_close t) taken || hides_spin t taken)|},
        {|not (exists_taken (may_close t) taken || (false && hides_spin t taken))|} );
    ]

let conclusion_in_walks =
  in_file "lib/semantics/rules/conclusion.ml" ~noticed_by:"semantics/test_invariants"
    [
      ( "an end releases nothing",
        {|{ s with allocation = Vehicle_map.empty; bound = [] }|},
        {|{ s with allocation = Vehicle_map.empty }|} );
    ]

let allocation_in_traps =
  in_file "lib/semantics/rules/allocation.ml" ~noticed_by:"reduction/test_traps"
    [
      ( "an outer T[V] does not count",
        {|| Some ws -> Some (List.filter (fun v -> List.mem v ws) vs)|},
        {|| Some _ -> Some vs|} );
      ( "tasks in turn need different vehicles",
        {|Sequence (a, b) -> Shared (both|},
        {|Sequence (a, b) -> Disjoint (both|} );
    ]

let answers_in_words =
  in_file "lib/semantics/elaboration/elaborate.ml" ~noticed_by:"semantics/test_language"
    [
      ( "no is yes in answers",
        {|| "no" | "n" | "false" -> { e with it = Boolean false }|},
        {|| "no" | "n" | "false" -> { e with it = Boolean true }|} );
    ]

let confirm =
  in_file "lib/semantics/elaboration/calls.ml" ~noticed_by:"semantics/test_language"
    [
      ( "confirm takes any answer",
        {|expression env at (While (open_, again))|},
        {|(ignore open_; again)|} );
    ]

let local_step_in_traps =
  in_file "lib/semantics/rules/local_step.ml" ~noticed_by:"reduction/test_traps"
    [
      ( "any time is one for during",
        {|when Time.is_one seconds|},
        {|when seconds < Time.longest|} );
    ]

let unknown =
  in_file "lib/semantics/language/unknown.ml" ~noticed_by:"semantics/test_language"
    [
      ( "what is unknown or true is unknown",
        {|if Value.truth x || Value.truth y then Boolean true else Unknown u|},
        {|Unknown u|} );
      ( "any of unknown ones is known",
        {|| (Any | Every | Sum), Some u -> Ok (Some (Unknown u))|},
        {|| (Any | Every | Sum), Some _ -> Ok None|} );
      ("unknown values are posted", {|Builtin (Message|}, {|Builtin (Post _ | Message|});
    ]
  @ in_file "lib/semantics/rules/local_step.ml" ~noticed_by:"semantics/test_rules"
    [
      ("a task that is made takes what others hold", {|(from free)|}, {|(from (if free = [] then bound else bound))|});
    ]
  @ in_file "lib/semantics/rules/residual.ml" ~noticed_by:"semantics/test_rules"
    [ ("what was given to a task is not held", 
       {|  | Hold (vs, a) -> begun (each leaf (fun v -> Held v) vs acc) a|},
       {|  | Hold (_, a) -> begun acc a|} ) ]
  @ in_file "lib/explore/steps/expansion.ml" ~noticed_by:"explore/test_agreement"
    [ ("what stands beside a step holds nothing", {|if child == place then [] else standing x child|},
       {|if child == place then [] else (ignore (standing x child); [])|}) ]
  @ in_file "lib/explore/order/step_footprints.ml" ~noticed_by:"reduction/test_traps"
    [ ("ends free no vehicle", 
       {|let lost = union f { Footprint.empty with frees = lost step } in|},
       {|let lost = ignore (lost step); f in|} ) ]
  @ in_file "lib/explore/order/footprint.ml" ~noticed_by:"reduction/test_traps"
    [ ("to ask who runs is nobody's concern",
       {|  | Builtin (Make_idle | Is_running), _ -> { breaking with claims = All; looks = true }|},
       {|  | Builtin Make_idle, _ -> { breaking with claims = All; looks = true }|}) ]
  @ in_file "lib/explore/order/step_footprints.ml" ~noticed_by:"reduction/test_traps"
    [
      ("nobody sees a task start", {|    | Start (_, v), _ -> turning c v|}, {|    | Start _, _ -> Footprint.empty|});
      ( "nobody sees a task end while its vehicle is held",
        {|  { (turning c v) with remembered;|},
        {|  { Footprint.empty with remembered;|} );
    ]
  @ in_file "lib/semantics/rules/residual.ml" ~noticed_by:"semantics/test_branches"
    [
      ( "an index of branches has no ends of tasks",
        {|  | Running (_, v) -> [ End_on v ]|},
        {|  | Running (_, v) -> if String.length v > 1 then [] else [ End_on v ]|} );
      ( "an index of branches has not those of an index within",
        {|    | Parallel bs when Branches.is_indexed bs -> Branches.Within ::|},
        {|    | Parallel bs when Branches.is_indexed bs -> Branches.Recruits ::|} );
    ]
  @ in_file "lib/semantics/rules/branches.ml" ~noticed_by:"semantics/test_branches"
    [
      ( "branches that come keep the marks of those that went",
        {|Option.fold (Numbers.find_opt i branches) ~none:index ~some:unmark }|},
        {|Option.fold (Numbers.find_opt i branches) ~none:index ~some:(fun r -> ignore (unmark r); index) }|} );
      ( "branches run out of numbers", {|  if step > 0 then add_all|}, {|  if step >= 0 then add_all|} );
    ]
  @ in_file "lib/semantics/rules/residual.ml" ~noticed_by:"reduction/test_traps"
    [
      ( "an error stops nobody beside",
        {|    | Beside rs :: outer -> from (rs :: inside) found outer|},
        {|    | Beside _ :: outer -> from inside found outer|} );
      ( "a cut stops nobody before handlers ask",
        {|  from [ Lazy.from_val (List.concat_map own around) ] [] (List.rev around)|},
        {|  from (List.filter (fun _ -> false) [ Lazy.from_val (List.concat_map own around) ]) [] (List.rev around)|} );
    ]
  @ in_file "lib/explore/steps/memoised_steps.ml" ~noticed_by:"reduction/test_traps"
    [ ("who runs is the same in all states", {|needed @ running t around) in|},
       {|needed @ List.filter (fun _ -> false) (running t around)) in|}) ]
  @ in_file "lib/semantics/rules/local_step.ml" ~noticed_by:"reduction/test_traps"
    [ ("handlers see those run who were stopped beside", {|else without_tasks (Lazy.force inside) s in|},
       {|else (ignore inside; s) in|}) ]
  @ in_file "lib/semantics/language/procedures.ml" ~noticed_by:"semantics/test_language"
    [ ("every picked vehicle runs", {|Boolean (Vehicle_map.mem v.id context.allocation) in|},
       {|Boolean (List.mem v.id context.bound) in|}) ]
  @ in_file "lib/time/clocked.ml" ~noticed_by:"time/test_exact"
    [ ("tasks start first where code asks who runs", {|&& not o.program.asks_running|},
       {|&& (o.program.asks_running || true)|}) ]
  @ in_file "lib/semantics/terms/value.ml" ~noticed_by:"semantics/test_language"
    [ ("of a pair that was compared one part is enough", {|x == x' && y == y'|}, {|x == x' || y == y'|}) ]
  @ in_file "lib/semantics/language/dated_code.ml" ~noticed_by:"time/test_exact"
    [
      ("a date turns as it is passed", {|let reached = int_of_float (Float.ceil x)|},
       {|let reached = int_of_float (Float.ceil x) + 1|});
      ("comparisons are not mirrored", {|op = mirrored op; shift; bound = a|},
       {|op = (ignore mirrored; op); shift; bound = a|});
      ("a variable has the value that was assigned last", {|(Hashtbl.find_all assigned i)|},
       {|(Option.to_list (Hashtbl.find_opt assigned i))|});
      ("what is said may be compared", {|Binary (Add | Subtract | Multiply | Divide)), es)|},
       {|Binary (Add | Subtract | Multiply | Divide | Greater)), es)|});
    ]
  @ in_file "lib/semantics/language/dated_code.ml" ~noticed_by:"runtime/test_runtime"
    [
      ("a date that is reached comes again", {|List.filter (fun k -> k > now) (List.concat_map|},
       {|List.filter (fun k -> k >= now) (List.concat_map|});
      ("nothing but comparisons is asked again", {|if t.asked then (now + 1) :: later else later in|},
       {|if t.asked && t.others = [] then (now + 1) :: later else later in|});
      ("a date is as far as it is compared with", {|~some:(fun x -> around (bound +. x))|},
       {|~some:(fun _ -> around bound)|});
    ]
  @ in_file "lib/runtime/driver.ml" ~noticed_by:"runtime/test_runtime"
    [
      ("nobody waits for a date", {|&& next_date s = None|}, {|&& (next_date s = None || true)|});
      ("the date is that of the start", {|(Exactly (World.whole s.moment))|},
       {|(Exactly (World.whole (0. *. s.moment)))|});
    ]
  @ in_file "lib/trace/replay.ml" ~noticed_by:"trace/test_journals"
    [ ("journals have no date", {|if r.program.reads_now then { r with world|},
       {|if r.program.reads_now && r.stuck then { r with world|}) ]
  @ in_file "lib/time/clocked.ml" ~noticed_by:"time/test_exact"
    [
      ("code reads no date", {|World.at (Since s.date) world|}, {|World.at (Since (0 * s.date)) world|});
      ("dates count from the start each", {|Bounds.exactly (float_of_int (k - s.date))|},
       {|Bounds.exactly (float_of_int (k - (0 * s.date)))|});
    ]
  @ in_file "lib/time/inert.ml" ~noticed_by:"time/test_exact"
    [ ("ends are inert where code reads the date", {|&& (not o.program.reads_now)|},
       {|&& (not o.program.reads_now || true)|}) ]
  @ in_file "lib/explore/order/footprint.ml" ~noticed_by:"time/test_reductions"
    [ ("ends are inert where code asks who runs", {|dismisses program || program.asks_running|},
       {|dismisses program|}) ]
  @ in_file "lib/semantics/rules/local_step.ml" ~noticed_by:"semantics/test_language"
    [ ("assure fails when its guard is unknown", {|Value.truth x || Unknown.is x|}, {|Value.truth x|}) ]
  @ in_file "lib/semantics/language/machine.ml" ~noticed_by:"semantics/test_language"
    [
      ( "an unknown value is false in an if",
        {|
      | _, _ -> needs context u locals stack calls at)|},
        {|
      | _, _ when Value.truth (Unknown u) -> needs context u locals stack calls at
      | _, _ -> evaluate context fuel no locals stack calls)|} );
    ]

let on_interrupt =
  in_file "lib/semantics/rules/script_rules.ml" ~noticed_by:"semantics/test_rules"
    [
      ( "a way home is executed without bound vehicles",
        {|when bound <> [] && not|},
        {|when not|} );
    ]
  @ in_file "lib/semantics/rules/script_rules.ml" ~noticed_by:"semantics/test_language"
    [
      ( "whoever is on the way home begins it again",
        {|not (Machine.is_leaving m) ->|},
        {|not (Machine.is_leaving m && false) ->|} );
    ]
  @ in_file "lib/explore/steps/space.ml" ~noticed_by:"reduction/test_traps"
    [
      ( "what an interruption executes is the same in all orders",
        {|if Environment.may_leave options program then Reduction.Whole else reduction in|},
        {|if Environment.may_leave options program && false then Reduction.Whole else reduction in|} );
    ]

let driver =
  in_file "lib/runtime/driver.ml" ~noticed_by:"runtime/test_runtime"
    [
      ( "a question stays open on the way home",
        {|    Option.iter Lwt.cancel reply
|},
        {|    ignore reply
|} );
      ("an end that a stop has overtaken is read", {|drop s (Overtaken.by_stop v); |}, {||});
      ("an expiry that a cancellation has overtaken is read", {|drop s (Overtaken.by_cancel timer); |}, {||});
    ]

let pick_rules_in_traps =
  in_file "lib/semantics/rules/fit.ml" ~noticed_by:"reduction/test_traps"
    [
      ( "bound vehicles are picked again",
        {|not (Vehicle_set.mem v.id bound) in|},
        {|not (Vehicle_set.mem v.id bound && false) in|} );
    ]

let limits =
  in_file "lib/checker/search/limits.ml" ~noticed_by:"explore/test_verdicts"
    [
      ( "what the process takes beside states and heap does not count",
        {|(used + g.unseen + growth)|},
        {|(used + (0 * g.unseen) + growth)|} );
    ]

let looks =
  in_file "lib/explore/verdict/looks.ml" ~noticed_by:"explore/test_looks"
    [ ("looks never contradict each other", {|(not (List.exists (contradict a) known.holds))|},
       {|(not (List.exists (contradict a) known.holds && false))|}) ]
  @ in_file "lib/explore/verdict/fair_cycles.ml" ~noticed_by:"explore/test_looks"
    [ ("time passes before an action that reads sensors", {|(chooses p.step.source || not p.depends)|},
       {|(not p.depends)|}) ]

let fair_cycles =
  in_file "lib/explore/verdict/fair_cycles.ml" ~noticed_by:"explore/test_fairness"
    [
      ( "what is possible is owed in the next round too",
        {|List.filter (fun k -> not (is_renewed k)) (node t first).possible|},
        {|List.filter (fun k -> not (is_renewed k && false)) (node t first).possible|} );
      ( "all of the repeat that goes on is renewed",
        {|begins_with (repeat @ [ Space.inside ]) at) renewed|},
        {|begins_with [] at && repeat <> []) renewed|} );
      ( "nothing is owed",
        {|List.filter (fun k -> not (Hashtbl.mem taken k)) (owed t edges members)|},
        {|List.filter (fun k -> not (Hashtbl.mem taken k) && false) (owed t edges members)|} );
      ( "a recruit is owed whoever may stay away",
        {|not (Space.may_all_stay_away system key vs)|},
        {|Space.may_all_stay_away system key vs || true|} );
      ( "the first who comes decides whether a recruit is owed",
        {|not (Space.may_all_stay_away system key vs)|},
        {|not (Space.may_all_stay_away system key [ List.hd vs ])|} );
    ]

let missions =
  in_file "lib/semantics/language/mission_builder.ml" ~noticed_by:"plan/test_mission"
    [
      ("a place before metres is metres", {|lists_place && is_place first|}, {|lists_place && is_place first && false|});
      ("what an item lacks is not told", {|p.is_required && not|}, {|p.is_required && false && not|});
      ("jumps go anywhere", {|n > float_of_int count|}, {|n > 99. +. float_of_int count|});
    ]
  @ in_file "lib/plans/mission_plan.ml" ~noticed_by:"plan/test_mission"
    [
      ("photos need no camera", {|"captureUntilStop" ]|}, {|"captureUntilstop" ]|});
      ("arm counts in jumps", {|[ "arm"; "altitude" ]|}, {|[ "altitude" ]|});
      ("a jump is taken once more", {|taken >= times|}, {|taken > times|});
    ]

let alike_values =
  in_file "lib/explore/symmetry/alike_values.ml" ~noticed_by:"reduction/test_alike_values"
    [
      ("plans of the fleet end as all others", {|if may_name code.plans parts || not|}, {|if (may_name code.plans parts && false) || not|});
      ("inputs bring no values of their own", {|(Keys.union looked_into brought)|}, {|(Keys.diff looked_into (Keys.diff brought brought))|});
      ("the task of an error names no plan", {|function 1 -> Other | _ -> Text|}, {|function 1 | 2 -> Other | _ -> Text|});
      ("any key may be asked for by a name", {|  | Apply (Builtin (Poll []), _) -> true|}, {|  | Apply (Builtin (Poll []), _) -> false|});
      ("a name may be empty", {| || not (List.exists is_text parts) then raise|}, {| && List.exists is_text parts then raise|});
      ("a text of a value is posted", {|        | Some k, Value -> code.posted|}, {|        | Some k, (Value | Text) -> code.posted|});
      ("pairs that are asked for are not looked into", {|    | Some k, _ -> [ k ]|}, {|    | Some _, _ -> []|});
      ( "values posted where they are looked into stay alike",
        {|      | Some posted when Keys.disjoint posted looked -> looked|},
        {|      | Some posted when Keys.disjoint posted looked || not (Keys.is_empty taken) -> looked|} );
      ("functions take nothing", {|      | Apply (Call _, _) -> raise Looked_at
      | _ -> ()
    in
    Code_walk.iter visit [ lambda ];|}, {|      | _ -> ()
    in
    Code_walk.iter visit [ lambda ];|});
      ("globals keep nothing", {|  | Set_global (_, e) -> nothing code e|}, {|  | Set_global (_, e) -> ignore (value_of code e); Other|});
      ("handlers may do anything with an error's text", {|  check_handlers plans program;|}, {|  if false then check_handlers plans program;|});
    ]

let maps =
  in_file "lib/maps/feature.ml" ~noticed_by:"maps/test_maps"
    [
      ("lines go round the globe", {|p.longitude) > 180. ->|}, {|p.longitude) > 380. ->|});
      ("lines are cut at zero", {|let side = if a.longitude < 0. then -180. else 180. in|}, {|let side = 180. in|});
      ("milliseconds are cut off", {|Float.round (seconds *. 1000.)|}, {|Float.floor (seconds *. 1000.)|});
    ]
  @ in_file "lib/maps/map_text.ml" ~noticed_by:"maps/test_maps"
    [
      ("quotes in tables stay alone", {|String.concat "\"\"" (String|}, {|String.concat "\"" (String|});
      ("a line of one position", {|function [ x ] -> [ x; x ]|}, {|function [ x ] -> [ x ]|});
      ("control characters in XML", {|if c < ' ' &&|}, {|if c < '\000' &&|});
      ("routes before way points", {|[ point_of; route_of; track_of ]|}, {|[ route_of; point_of; track_of ]|});
    ]
  @ in_file "lib/maps/map_file.ml" ~noticed_by:"maps/test_maps"
    [
      ("what has no name is counted from 0", {|free kind ~from:1|}, {|free kind ~from:0|});
      ("names that stand in the file are given to others", {|Hashtbl.mem own name || Hashtbl.mem taken name|},
       {|Hashtbl.mem taken name|});
      ("names are used twice", {|else if Hashtbl.mem taken name then free name|}, {|else if false then free name|});
      ("long files are read", {|String.length text > most_bytes|}, {|String.length text > 2 * most_bytes|});
      ("only the first polygon counts", {|united place (List.map polygon rings)|},
       {|united place [ polygon (List.hd rings) ]|});
      ("holes are filled", {|~holes:(List.map opened holes)|}, {|~holes:(List.map opened (List.tl (rim :: holes |> List.rev)))|});
    ]
  @ in_file "lib/maps/json_text.ml" ~noticed_by:"maps/test_maps"
    [ ("latitudes come first", {|Longitude_first -> (y, x)|}, {|Longitude_first -> (x, y)|}) ]
  @ in_file "lib/maps/geojson_file.ml" ~noticed_by:"maps/test_maps"
    [
      ("features count from 0", {|"feature %d%s" (i + 1)|}, {|"feature %d%s" i|});
      ("any authority's 4326 is WGS 84", {|("4326" | "4979") :: _ -> is_of_epsg|}, {|("4326" | "4979") :: _ -> is_of_epsg || true|});
    ]
  @ in_file "lib/maps/qgc_plan_file.ml" ~noticed_by:"maps/test_maps"
    [
      ("local frames are on the globe", {|let global_frames = [ 0; 3|}, {|let global_frames = [ 0; 1; 3|});
      ("fences keep in what they keep out", {|`Bool false -> "outside"|}, {|`Bool false -> "inside"|});
      ("an item without a position is at 0, 0", {|latitude = 0. && longitude = 0.|}, {|latitude = 1. && longitude = 0.|});
    ]
  @ in_file "lib/maps/zip_text.ml" ~noticed_by:"maps/test_maps"
    [ ("checksums of archives are not compared", {||| checksum contents <> entry.check|}, {||| (checksum contents <> entry.check && false)|}) ]
  @ in_file "lib/geo/repair.ml" ~noticed_by:"maps/test_maps"
    [ ("rims that cross themselves make areas", {|(0.001 *. whole)|}, {|(1000. *. Float.abs whole)|}) ]
  @ in_file "lib/maps/neptus_file.ml" ~noticed_by:"maps/test_maps"
    [
      ("west is east", {|letter = 'S' || letter = 'W'|}, {|letter = 'S'|});
      ("depths are heights", {|-. metres "depth" c|}, {|+. metres "depth" c|});
      ("boxes are not turned", {|x centre (a *. ahead) (r *. right)|}, {|x centre (r *. right) (a *. ahead)|});
      ("minutes are seconds", {|(part 0 /. 60.)|}, {|(part 0 /. 3600.)|});
    ]
  @ in_file "lib/maps/xml_text.ml" ~noticed_by:"maps/test_maps"
    [ ("a fault is told behind its place", {|place = line }|}, {|place = "line " ^ string_of_int (fst (Xmlm.pos input)) }|}) ]

let division =
  in_file "lib/geo/division.ml" ~noticed_by:"geo/test_parts"
    [
      ( "a cut through corners may cut off too much",
        {|if exact && count_outer|},
        {|if (exact || true) && count_outer|} );
      ( "parts of areas are not equally large",
        {|let wanted = whole *. float_of_int parts /.|},
        {|let wanted = 0.99 *. whole *. float_of_int parts /.|} );
    ]

let arrangement =
  in_file "lib/geo/arrangement.ml" ~noticed_by:"geo/test_parts"
    [
      ( "sides that cross by a unit take each other's place",
        {|2 * abs o <= abs x + abs y|},
        {|abs o <= abs x + abs y|} );
    ]

let coverage =
  in_file "lib/geo/bands.ml" ~noticed_by:"geo/test_coverage"
    [
      ( "strips are as long as their lines",
        {|let left = Float.min (at t.left slice.foot) (at t.left slice.top) in|},
        {|let left = (at t.left slice.foot +. at t.left slice.top) /. 2. in|} );
      ( "holes part no strips",
        {|if a.band = b.band then|},
        {|if a.band = b.band || true then|} );
    ]
  @ in_file "lib/geo/tour.ml" ~noticed_by:"geo/test_coverage"
    [
      ("ways go straight across holes", {|if neighbours parts a b then []|}, {|if neighbours parts a b || true then []|});
      ("any order will do", {|if cost < best.(set lor bit).(j) then|}, {|if best.(set lor bit).(j) = infinity then|});
      ("all strips are gone along the same way", {|{ part; rightwards = rightwards = (i mod 2 = 0) }|}, {|{ part; rightwards = rightwards = (i mod 2 >= 0) }|});
    ]
  @ in_file "lib/geo/coverage.ml" ~noticed_by:"geo/test_coverage"
    [
      ("overlap spreads strips", {|(1. -. settings.overlap)|}, {|(1. +. settings.overlap)|});
      ("turns at one end only", {|let left = (part.Bands.left -. turn, part.height)|}, {|let left = (part.Bands.left, part.height)|});
    ]

let zone =
  in_file "lib/time/zone.ml" ~noticed_by:"time/test_zone"
    [
      ( "a bound is not carried over to other clocks",
        {|          let by = before + c ++ get z b j in|},
        {|          let by = if i = a || j = b then before + c ++ get z b j else unbounded in|} );
      ( "an empty zone is not seen",
        {|else if get z b a ++ c < 0 then None|},
        {|else if get z b a ++ c < -1 then None|} );
      ( "time passes for the date alone",
        {|for i = 1 to z.n - 1 do set z i zero unbounded done;|},
        {|for i = 1 to 1 do set z i zero unbounded done;|} );
      ( "a zone is part of another of which it is not",
        {|let rec go k = k < 0 || (Array.unsafe_get z.m k <= Array.unsafe_get z'.m k && go (k - 1)) in
  go (Array.length z.m - 1)|},
        {|let rec go k = k < 0 || (Array.unsafe_get z.m k <= Array.unsafe_get z'.m k && go (k - 1)) in
  go (Array.length z.m - 3)|} );
      ( "what begins keeps the clock of another",
        {|Some k -> k + 1 | None -> zero in|},
        {|Some k -> k + 1 | None -> date in|} );
      ( "put off by too much",
        {|go i (j + 1) least (min most (other - mine))|},
        {|go i (j + 1) least most|} );
    ]

let timed =
  in_file "lib/time/clocked.ml" ~noticed_by:"time/test_exact"
    [
      ( "a task that fails does so at its end only",
        {|  let failed = Bounds.from_the_start done_ in|},
        {|  let failed = done_ in|} );
      ( "a lost link is noticed at once",
        {|    | Within { most; _ }, Within { least; _ } -> Within { least; most }|},
        {|    | Within { most; _ }, Within _ -> Within { least = 0; most }|} );
      ( "no look ends a task at the moment at which something happens at once",
        {|if is_event o s choice then None else Some step in|},
        {|if (not (is_event o s choice)) && step.urgent then Some step else None in|} );
      ( "the order to a lost vehicle does not wait",
        {|if List.mem v (Environment.lost s.outside) then put_off silence bounds else bounds in|},
        {|ignore put_off; bounds in|} );
      ( "who joins is there at once",
        {|World.suppose (attendance o s) o.world in|},
        {|(ignore attendance; o.world) in|} );
      ( "vehicles that joined are in the order of the fleet",
        {|List.map (fun v -> World.Late v) late @|},
        {|(ignore late; []) @|} );
      ( "a pick does not wait for who joins",
        {|| None when is_pick && not (has_links o) ->|},
        {|| None when is_pick ->|} );
      ( "an order does not wait for the link",
        {|[ task Ordered; no_more (Silence v) (patience o s v) ] else|},
        {|[ task Under_way; no_more (Silence v) (patience o s v) ] else|} );
      ( "nothing ends while nothing is heard",
        {|all @ unheard_ends o s @|},
        {|all @ (ignore unheard_ends; []) @|} );
      ( "what has ended unheard goes on",
        {|if p.progress = Over then Bounds.at_once else p.bounds|},
        {|p.bounds|} );
      ( "a silent vehicle is heard",
        {|Seq.filter (is_heard o s)|},
        {|Seq.filter (fun c -> is_heard o s c || true)|} );
      ( "a silent link is waited for without end",
        {|(List.to_seq (given_up o world s))|},
        {|(ignore given_up; Seq.empty)|} );
      ( "links of vehicles in B do not matter during tasks",
        {|let matters v = (not settled) || List.mem v s.configuration.shared.bound in|},
        {|let matters _ = not settled in|} );
    ]

let place =
  in_file "lib/time/zone_node.ml" ~noticed_by:"time/test_exact"
    [
      ( "nothing has to happen",
        {|List.fold_left limit (Some (Zone.delay zone)) (snd (follow t place))|},
        {|List.fold_left (fun zone _ -> ignore limit; zone) (Some (Zone.delay zone)) (snd (follow t place))|} );
      ( "steps are taken too early",
        {|        let* zone = Zone.at_least clock least zone in
|},
        {|        let* zone = Zone.at_least clock (min 0 least) zone in
|} );
      ( "time passes though a step is urgent",
        {|if steps = [] || List.exists (fun (s : Clocked.step) -> s.urgent) steps then Some (filled zone)|},
        {|if steps = [] then Some (filled zone)|} );
    ]
  @ in_file "lib/time/zone_node.ml" ~noticed_by:"time/test_reductions"
    [
      ( "the rest is over though not all of it is",
        {|    let* zone = Option.bind zone (Zone.at_most clock (-i.least)) in|},
        {|    let* zone = if last = None then zone else Option.bind zone (Zone.at_most clock (-i.least)) in|} );
      ( "the last end of the rest may come too late",
        {|Zone.at_least clock (-i.most) zone|},
        {|Zone.at_least clock (-i.most - 1_000) zone|} );
      ( "of steps that lead to alike states only one is noticed",
        {|let key = (due, step.urgent, what,|},
        {|let key = (due, step.urgent, ignore what,|} );
    ]
  @ in_file "lib/time/batteries.ml" ~noticed_by:"time/test_exact"
    [
      ( "a vehicle that is stopped goes on",
        {|if doing = Clocked.doing options before vehicle then None|},
        {|if doing = Rests || Clocked.doing options before vehicle <> Rests then None|} );
    ]
  @ in_file "lib/time/clocked.ml" ~noticed_by:"time/test_missions"
    [
      ( "an order that waits for a link takes as much as a task",
        {|p.item = Task v && p.progress = Under_way|},
        {|p.item = Task v && p.progress <> Over|} );
      ( "a task that is over unheard takes as much as before",
        {|p.item = Task v && p.progress = Under_way|},
        {|p.item = Task v && p.progress <> Ordered|} );
    ]
  @ in_file "lib/time/working.ml" ~noticed_by:"time/test_missions"
    [
      ( "the bound counts orders that wait as work",
        {|     | Ordered, _ -> None|},
        {|     | Ordered, _ -> Some (v, since)|} );
      ( "the bound counts what is over unheard as work",
        {|     | Over, Within { most; _ } -> Some (v, min since most)|},
        {|     | Over, Within { most; _ } -> Some (v, max since most)|} );
    ]
  @ in_file "lib/time/working.ml" ~noticed_by:"time/test_exact"
    [
      ( "tasks that are stopped take nothing",
        {|    when ((not (is_awaited p.item)) || List.mem p.item step.fresh)|},
        {|    when (not (is_awaited p.item)) && step.due <> None|} );
      ( "inert ends take nothing",
        {|Some (task.vehicle, i.most)|},
        {|Some (task.vehicle, 0 * i.most)|} );
    ]
  @ in_file "lib/time/clocked.ml" ~noticed_by:"time/test_exact"
    [
      ( "a plan charges until its end is heard",
        {|-> charges :: at_rest o v|},
        {|-> [ charges ]|} );
      ( "rest charges wherever it is",
        {|then [ Away; Rests ] else|},
        {|then [ Rests ] else|} );
    ]
  @ in_file "lib/time/levels.ml" ~noticed_by:"time/test_exact"
    [
      ( "rest charges for as long as it may last",
        {|if rate >= 0. then Float.max k.entry (after rate least k.low)|},
        {|if rate >= 0. then Float.max k.entry (after rate (Option.value most ~default:least) k.low)|} );
      ( "work takes its shortest time",
        {|match most with Some ms -> after rate ms k.low|},
        {|match most with Some ms -> after rate (min ms least) k.low|} );
      ( "of several ways to a state the first is taken",
        {|if b.low < a.low || b.high > a.high || b.entry < a.entry then|},
        {|if b.high > a.high || (b.low < a.low && false) then|} );
    ]
  @ in_file "lib/time/course.ml" ~noticed_by:"time/test_missions"
    [
      ( "a comparison is taken for its opposite",
        {|if is_less = holds then|},
        {|if is_less <> holds then|} );
      ( "what is known of a battery before its link went is taken for now",
        {|  && not (Links.may_go (Durations.links_with faults c.options.durations) c.vehicle)|},
        {|  && not (Links.may_go (Links.only_first (Durations.links_with faults c.options.durations)) c.vehicle)|} );
    ]
  @ in_file "lib/time/longest.ml" ~noticed_by:"time/test_exact"
    [
      ( "the first way is taken for the longest",
        {|    if way > longest.(w) then begin|},
        {|    if longest.(w) < 0 && way > longest.(w) then begin|} );
    ]
  @ in_file "lib/scenario/battery.ml" ~noticed_by:"time/test_missions"
    [
      ( "rest takes nothing",
        {|let at_rest = 0.25|},
        {|let at_rest = 0.|} );
      ( "charging is counted on",
        {|if v.charge > 0. && v.chargers = [] then 0. else unplugged v|},
        {|if v.charge > 0. && v.chargers = [] then resting v else unplugged v|} );
      ( "plans that charge drain",
        {|  | Charges share -> share /. hour|},
        {|  | Charges _ -> under_way v|} );
    ]
  @ in_file "lib/time/slack.ml" ~noticed_by:"time/test_missions"
    [
      ( "a task may take a millisecond too much",
        {|if later - kept = 1 then kept|},
        {|if later - kept = 1 then later|} );
      ( "a task that is cut off counts with all its time",
        {|  | None -> Some Any|},
        {|  | None -> Some (By 0)|} );
    ]
  @ in_file "lib/time/inert.ml" ~noticed_by:"time/test_reductions"
    [
      ( "a task that may fail is inert",
        {|not (Environment.may_fail i.options.environment v p.name)|},
        {|Environment.may_succeed i.options.environment v p.name|} );
      ( "ends are inert where code reads sensors",
        {|(not o.program.reads_sensors)|},
        {|(o.program.reads_sensors || true)|} );
      ( "ends are inert where code asks who is held",
        {|not (Footprint.asks_held o.program)|},
        {|(Footprint.asks_held o.program || true)|} );
    ]
  @ in_file "lib/explore/order/numeric.ml" ~noticed_by:"time/test_reductions"
    [
      ( "every variable is a number",
        {|List.for_all placed (Hashtbl.find_all t.globals i)|},
        {|(List.for_all placed (Hashtbl.find_all t.globals i) || true)|} );
      ( "every local is a number",
        {|List.for_all known (in_local t within slot)|},
        {|(List.for_all known (in_local t within slot) || true)|} );
      ( "functions are called by their names alone",
        {|is_function && List.compare_lengths calls (Hashtbl.find_all t.mentions lambda.id) = 0|},
        {|is_function|} );
      ( "parameters are not assigned to",
        {|(if slot < lambda.parameters then given t lambda slot else []) @ Hashtbl.find_all t.locals (lambda.id, slot)|},
        {|if slot < lambda.parameters then given t lambda slot else Hashtbl.find_all t.locals (lambda.id, slot)|} );
    ]
  @ in_file "lib/time/canonical_state.ml" ~noticed_by:"time/test_reductions"
    [
      ( "plans of any time are alike",
        {|Milliseconds (least, most)|},
        {|Milliseconds (0 * least, 0 * most)|} );
      ( "all tasks are in one orbit",
        {|2 * Bool.to_int (l = l')|},
        {|0 * Bool.to_int (l = l')|} );
      ( "what is left in N may have any names",
        {|    times.(n) = Hashtbl.find of_orbit orbit|},
        {|    true|} );
      ( "in what order alike tasks leave N makes no difference",
        {|(times.(n) = 0 || not (|},
        {|(times.(n) >= 0 || not (|} );
    ]
  @ in_file "lib/time/form.ml" ~noticed_by:"time/test_reductions"
    [
      ( "what is in order is in none",
        {|let written = if ordered then written else List.sort compare written in|},
        {|let written = ignore ordered; List.sort compare written in|} );
    ]

let timed_system =
  in_file "lib/time/timed_system.ml" ~noticed_by:"time/test_exact"
    [
      ( "the latest dates are filled up",
        {|Latest -> Zone.reaching_down | Earliest -> Zone.reaching_up in|},
        {|Latest -> Zone.reaching_up | Earliest -> Zone.reaching_down in|} );
      ( "states include those that they do not",
        {|List.find_opt (fun m -> Zone.subset zone t.nodes.(m).zone) place.here in|},
        {|List.find_opt (fun _ -> true) place.here in|} );
      ( "only what the search goes round is a cycle",
        {|if t.cycle = None && t.returns <> [] then|},
        {|if t.cycle <> None && t.returns <> [] then|} );
      ( "dates are forgotten",
        {|Latest -> Zone.reaching_down|},
        {|Latest -> Zone.at_any_date|} );
      ( "any state that was seen is gone round to",
        {|    if by >= 0 && is_before t m n then Some (m, by) else None|},
        {|    if by >= 0 && (is_before t m n || m >= 0) then Some (m, by) else None|} );
    ]

let schedule =
  in_file "lib/time/dates.ml" ~noticed_by:"time/test_missions"
    [
      ( "runs that end last do not wait for one another",
        {|(fun known -> sooner + bound.by < known)|},
        {|(fun known -> sooner + bound.by > known)|} );
    ]
  @ in_file "lib/time/schedule.ml" ~noticed_by:"time/test_missions"
    [
      ( "the chain has no links",
        {|due_to = Some (pending : Clocked.pending); later } when by > 0|},
        {|due_to = Some (pending : Clocked.pending); later } when by > max_int - 1|} );
    ]

let recorded =
  in_file "lib/time/recorded.ml" ~noticed_by:"time/test_recorded"
    [
      ( "what takes too long is not seen",
        {|heard_by r p.item (began + most) -> finding false|},
        {|heard_by r p.item (began + (10 * most)) -> finding false|} );
      ( "tasks end in time though nothing is heard of them",
        {|Task v when List.mem v r.silent -> max_int|},
        {|Task v when List.mem v r.silent && date < 0 -> max_int|} );
      ( "orders that wait for the link have begun",
        {|if item = Clocked.Task v && List.mem v r.ordered then date else began|},
        {|if item = Clocked.Task v && date < 0 then date else began|} );
      ( "what is over too soon is not seen",
        {|when must_have_run && date - began < least - r.tolerance -> finding true|},
        {|when must_have_run && date - began < min 0 least -> finding true|} );
    ]

let durations =
  in_file "lib/time/durations.ml" ~noticed_by:"time/test_missions"
    [
      ( "ways take no longer than they should",
        {|((moving *. (1. +. tolerance)) +. staying)|},
        {|(moving +. staying)|} );
    ]
  @ in_file "lib/plans/inline_plan.ml" ~noticed_by:"time/test_missions"
    [ ("stays take no time", {|staying = e.staying +. leg.dwell|}, {|staying = e.staying|}) ]

let share =
  in_file "lib/statistics/share.ml" ~noticed_by:"statistics/test_statistics"
    [
      ("both tails on one side", {|(1. -. level) /. 2. and|}, {|(1. -. level) and|});
      ( "the upper end is that of a hit less",
        {|inverse (incomplete_beta (k +. 1.) misses)|},
        {|inverse (incomplete_beta k misses)|} );
      ("looks cost nothing", {|Float.of_int (j * (j + 1))|}, {|Float.of_int (j * j)|});
    ]

let transition_systems =
  in_file "lib/explore/verdict/transition_system.ml" ~noticed_by:"explore/test_transition_system"
    [
      ( "states have the numbers that processes gave them",
        {|      numbers.(id) <- !known;
      ids.(!known) <- id;
      incr known|},
        {|      numbers.(id) <- id;
      ids.(id) <- id;
      incr known|} );
    ]
  @ in_file "lib/explore/temporal/observer.ml" ~noticed_by:"explore/test_transition_system"
    [
      ("what is checked is not seen", {|t.action { label = named; effects|},
       {|t.action { label = (match named with Check _ -> Silent | label -> label); effects|});
      ( "whoever has no end in sight sees nothing",
        {|let of_event observer ?ending label = seen observer|},
        {|let of_event observer ?ending label = seen (if ending = None then None else observer)|} );
    ]

let files_of_states =
  in_file "lib/explore/verdict/search.ml" ~noticed_by:"explore/test_agreement"
    [ ("files of states stay open", {|Fun.protect ~finally:(fun () -> State_graph.close graph) (fun () -> f graph)|},
       {|f graph|}) ]

let sampled =
  in_file "lib/app/sampling/sampling.ml" ~noticed_by:"time/test_sampled"
    [
      ( "runs count as they come",
        {|  let seed = settings.seed + tally.count in|},
        {|  let seed = Hashtbl.fold (fun seed _ _ -> seed) waiting (settings.seed + tally.count) in|} );
    ]
  @ in_file "lib/app/sampling/sample.ml" ~noticed_by:"time/test_sampled"
    [
      ( "handlers that hand an error on do not count",
        {|    | Watch_ignore | Watch_propagate | Watch_halt|},
        {|    | Watch_ignore | Watch_halt|} );
    ]
  @ in_file "lib/app/sampling/sample_lines.ml" ~noticed_by:"time/test_sampled"
    [
      ("times to the second", {|Canonical.number s.seconds|}, {|Canonical.number (Float.round s.seconds)|});
      ( "tasks failed whoever had them",
        {|("cause", `String "task"); ("vehicle", `String vehicle); ("task", `String task)|},
        {|("cause", `String "task"); ("vehicle", `String (vehicle ^ "?")); ("task", `String task)|} );
      ("runs may be missing", {|when seed = last + 1 -> Ok ()|}, {|when seed > last -> Ok ()|});
    ]

let processes =
  in_file "lib/processes/workers.ml" ~noticed_by:"processes/test_workers"
    [
      ("what was written in part is written again", {|Unix.single_write|}, {|Unix.write|});
      ("each process computes all", {|      from (n + jobs)|}, {|      from (n + min jobs 1)|});
      ( "who ends early has done all",
        {|  | 0 when is_past last w.next ->|},
        {|  | 0 when is_past last w.next || w.next > 0 ->|} );
      ("processes outlive whoever made them", {|if Unix.getppid () <> parent then|}, {|if parent = 0 then|});
      ("processes heed Ctrl-C", {|Sys.Signal_ignore) [ Sys.sigint; Sys.sighup; Sys.sigxfsz ]|}, {|Sys.Signal_default) [ Sys.sigint ]|});
    ]
  @ in_file "lib/time/share_out.ml" ~noticed_by:"time/test_workers"
    [
      ("all processes report", {|(f { limits with progress = ignore })|}, {|(f limits)|});
      ( "an interruption is a lack of time",
        {|      | exception Limits.Stop bound -> (found, Some bound)|},
        {|      | exception Limits.Stop _ -> (found, Some Limits.Time)|} );
      ("the other processes are left alone", {|~finally:(fun () -> Workers.stop workers)|}, {|~finally:ignore|});
      ( "there may be other processes if memory has a bound",
        {|if limits.max_memory = None then min workers count else 1|},
        {|if limits.max_memory = None then min workers count else min workers 2|} );
    ]
  @ in_file "lib/time/timed_analysis.ml" ~noticed_by:"time/test_missions"
    [ ("slacks of other tasks", {|(tasks.(i), slack)) slack) found;|}, {|(tasks.(count - 1 - i), slack)) slack) found;|}) ]

let travel =
  in_file "lib/semantics/language/travel.ml" ~noticed_by:"plan/test_travel"
    [
      ("stays are not asked for", {|~seconds:(moving +. staying)|}, {|~seconds:moving|});
      ( "plans of one name are one plan",
        {|(spell (Number one_metre)) (spell (Number rest))|},
        {|(spell (Number one_metre)) p.name|} );
      ("an hour has a hundred minutes", {|told s.drain /. 3600.|}, {|told s.drain /. 6000.|});
    ]
  @ in_file "lib/explore/symmetry/name_flow.ml" ~noticed_by:"reduction/test_told_apart"
    [ ("all vehicles are equally fast", {|places = true; abilities = true|}, {|places = true|}) ]

let search_pattern =
  in_file "lib/geo/search_pattern.ml" ~noticed_by:"geo/test_search_pattern"
    [
      ("the triangles of a sector overlap", {|datum; at 240.; at 300.;|}, {|datum; at 180.; at 240.;|});
      ("squares end early", {|(4. *. rings) +. 1.|}, {|(4. *. rings) -. 3.|});
      ("spirals end early", {|((radius /. spacing) +. 0.5)|}, {|(radius /. spacing)|});
    ]

let heights =
  in_file "lib/platform_sim/profile.ml" ~noticed_by:"platform_sim/test_track"
    [
      ("vehicles dive deeper than they were told", {|Float.max height (from -. metres)|}, {|from -. metres|});
      ("yo-yos jump into their bounds", {|(Float.abs (nearest -. s.now) /. rate)|}, {|0.|});
      ("yo-yos only come up", {|if gone <= span then high -. gone|}, {|if gone > 0. then high -. gone|});
    ]
  @ in_file "lib/platform_sim/track.ml" ~noticed_by:"platform_sim/test_track"
    [
      ("yo-yos on the way to where they are asked for", {|~swings:(leg.dwell = 0.)|}, {|~swings:true|});
      ("depths are left to the next place", {|~some:(fun profile -> Float.max moves_until (Profile.still_from profile))|},
       {|~some:(fun _ -> moves_until)|});
    ]
  @ in_file "lib/platform_sim/execution.ml" ~noticed_by:"platform_sim/test_fleet"
    [
      ("divers fly", {|(Depth | Height) -> Some (Float.min 0.)|}, {|(Depth | Height) -> Some Fun.id|});
      ("planes dive", {|"UAV", Depth -> None|}, {|"UAV", Depth -> Some Fun.id|});
    ]
  @ in_file "lib/plans/plan.ml" ~noticed_by:"plan/test_plan_path"
    [
      ("paths go up instead of down", {|0. -. (z +. down)|}, {|0. -. (z -. down)|});
      ("who pops up stays below", {|measured_from = Depth; stays_at = 0. }|}, {|measured_from = Depth }|});
    ]
  @ in_file "lib/plans/mission_plan.ml" ~noticed_by:"plan/test_mission"
    [ ("who lands stays in the air", {|[ "returnHomeAndLand"; "landingPoint" ]|}, {|[ "landingPoint" ]|}) ]
  @ in_file "lib/geo/polyline.ml" ~noticed_by:"geo/test_polyline"
    [
      ("ways end early", {|min last ((k + 1) * most_at_once)|}, {|(k + 1) * most_at_once - 1|});
      ("ways there and back are cut short", {|along <= 0. then ap|}, {|along <= 0. then 0.|});
      ("only one corner is found", {|look ((from, i) :: (i, until) :: others)|}, {|look ((i, until) :: others)|});
    ]

let narrow_bars =
  in_file "lib/trace/picture/timeline.ml" ~noticed_by:"trace/test_pictures"
    [
      ("names of narrow bars lie on each other", {|last.x +. last.width +. 10. > x|}, {|last.x > x|});
      ( "names of narrow bars leave the picture",
        {|Float.min group.x (f.right -. group.width)|},
        {|Float.min group.x f.right|} );
    ]

let vector =
  in_file "lib/semantics/terms/vector.ml" ~noticed_by:"semantics/test_vector"
    [
      ("lists change when another one is appended to", {| && !(xs.filled) = xs.length|}, {||});
      ( "lists are copied whenever they are appended to",
        {|if xs.length < Array.length xs.buffer && |},
        {|if xs.length < 0 && |} );
      ("a copy has no room", {|(max least_room (2 * xs.length))|}, {|(max (least_room * 0) (xs.length + 1))|});
    ]
  @ in_file "lib/semantics/language/operators.ml" ~noticed_by:"semantics/test_vector"
    [
      ( "lists are copied for each element",
        {|  | List xs, Integer i -> indexed x (Vector.length xs) (Vector.get xs) i
|},
        {|  | List xs, Integer i -> indexed x (Vector.length xs) (Array.get (Vector.to_array xs)) i
|} );
    ]

let prelude =
  in_file "lib/syntax/prelude.dol" ~noticed_by:"prelude/test_prelude"
    [
      ("one less than atLeast says is enough", {|count((done): _) >= k|}, {|count((done): _) >= k - 1|});
      ("a barrier holds nobody", {|condition { count((name): { it == 'came' }) == n }|}, {|condition { count((name): _) >= 1 }|});
      ("a follower is told of one end again and again", {|consume((name): 'done')|}, {|poll((name): 'done')|});
      ("the goal of who fails is lost", {|post((goal): g, (out): 1)|}, {|post((out): 1)|});
      ("who is at the very distance is not near", {|<= d }|}, {|< d }|});
    ]

let fresh_keys =
  in_file "lib/semantics/rules/maker.ml" ~noticed_by:"semantics/test_rules"
    [
      ( "tasks side by side have the same keys",
        {|let ns, numbers = split code.lambda.parameters numbers in|},
        {|let ns, _ = split code.lambda.parameters numbers in|} );
      ( "code that makes a task may do something",
        {|else if deeds <> [] || Store.compare|}, {|else if List.length deeds > 9 || Store.compare|} );
    ]
  @ in_file "lib/semantics/rules/task_rules.ml" ~noticed_by:"prelude/test_prelude"
    [
      ( "a task begins with the pairs of one that was cut off",
        {|List.concat_map ended change.undone @ List.filter_map begun change.timers|},
        {|ignore begun; List.concat_map ended change.undone|} );
    ]
  @ in_file "lib/semantics/rules/local_step.ml" ~noticed_by:"prelude/test_prelude"
    [
      ( "pairs of fresh keys stay",
        {|  let s = Shared.without_keys (List.map Residual.key (Task_rules.keys change)) s in
|},
        {||} );
      ( "pairs of fresh keys outlive the executed task",
        {|shared = Shared.without_fresh shared|},
        {|shared|} );
    ]
  @ in_file "lib/explore/order/step_footprints.ml" ~noticed_by:"reduction/test_traps"
    [ ("keys that are passed on touch nothing", {|if c.leaks then union f Footprint.anything else f|}, {|ignore c; f|}) ]
  @ in_file "lib/explore/symmetry/name_flow.ml" ~noticed_by:"reduction/test_traps"
    [
      ( "keys are not passed on by posts",
        {|match place with Posted | Variable _ -> has key k|},
        {|match place with Posted -> false | Variable _ -> has key k|} );
    ]
  @ in_file "lib/explore/encoding/components.ml" ~noticed_by:"explore/test_agreement"
    [
      ( "steps that forget keys depend on nothing",
        {|when Task_rules.keys change <> [] -> dependent event|},
        {|when false -> dependent event|} );
    ]

let all =
  List.concat
    [ fresh_keys; maps; missions; footprint; step_footprints; order_of_recruits; stubborn; automorphism;
      task_isomorphism;
      task_groups; quotient; expansion; portable; transition_systems; files_of_states;
      vehicle_orbits; canonical_vehicles; bitstate; workers; disk; name_flow; liveness; recruiting; later_picks;
      environment; picks; inputs;
      attendance;
      task_rules; local_step; run_code; answers_in_words; confirm; unknown; on_interrupt;
      fences; pick_rules; conclusion; recruits; allocation; tuple_space; task_rules_in_walks; local_step_in_walks;
      conclusion_in_walks; allocation_in_traps; local_step_in_traps; pick_rules_in_traps;
      sets_with_events; driver; looks; fair_cycles; limits;
      alike_values; division; arrangement; coverage; search_pattern; travel; heights; narrow_bars; vector;
      zone; timed; place; timed_system; schedule; recorded; durations; share; sampled; processes; prelude ]
