type t = { name : string; file : string; find : string; replace : string; noticed_by : string }

(* The mistakes in [file] that [noticed_by] must notice, each with the text that it replaces and the replacement. They
   quote as little of the code as finds their place. *)
let in_file file ~noticed_by mistakes =
  List.map (fun (name, find, replace) -> { name; file; find; replace; noticed_by }) mistakes

let all =
  List.concat
    [
      in_file "lib/app/exploration/successor_service.ml" ~noticed_by:"explore/test_successors"
        [
          ( "states keep the old encoding after fields grow",
            {|    t.reached <- States.rewrite t.reached ~words:(Space.words t.space) renewed;|},
            {|    t.reached <- States.rewrite t.reached ~words:(Space.words t.space) (fun old fresh ->
        if States.count t.reached < 0 then renewed old fresh
        else Array.blit old 0 fresh 0 (Array.length old));|} );
        ];
      in_file "lib/app/sampling/sample_lines.ml" ~noticed_by:"time/test_sampled"
        [
          ("times to the second", {|Canonical.number s.seconds|}, {|Canonical.number (Float.round s.seconds)|});
          ( "failures name another vehicle",
            {|("cause", `String "task"); ("vehicle", `String vehicle); ("task", `String task)|},
            {|("cause", `String "task"); ("vehicle", `String (vehicle ^ "?")); ("task", `String task)|} );
        ];
      in_file "lib/app/sampling/sampling.ml" ~noticed_by:"time/test_sampled"
        [
          ( "runs count as they come",
            {|  let seed = settings.seed + tally.count in|},
            {|  let seed = Hashtbl.fold (fun seed _ _ -> seed) waiting (settings.seed + tally.count) in|} );
        ];
      in_file "lib/checker/search/bitstate.ml" ~noticed_by:"checker/test_search"
        [
          ("one bit identifies a state", {|number = hashes |||}, {|number = 1 |||});
          ("hashes begin with a small number", {|0x2D35_8DCC_AA6C_78A5|}, {|1|});
        ];
      in_file "lib/checker/search/team.ml" ~noticed_by:"explore/test_workers"
        [
          ( "a process misses words of other processes",
            {|      catch_up t ~words f;
      let key|},
            {|      t.known <- get t logged;
      let key|} );
        ];
      in_file "lib/checker/store/disk_index.ml" ~noticed_by:"checker/test_states"
        [
          ("the index ends at the end of a window", {|if k = n then `Further|}, {|if k = n then `Found (-1)|});
        ];
      in_file "lib/checker/store/on_disk.ml" ~noticed_by:"checker/test_states"
        [
          ("known states are added again", {|known i '\001'|}, {|known i '\000'|});
        ];
      in_file "lib/checker/store/shared_states.ml" ~noticed_by:"checker/test_search"
        [
          ( "a run of parents begins with the one before",
            {|t.runs (at + 1) parent|},
            {|t.runs (at + 1) (parent - 1)|} );
        ];
      in_file "lib/environment/environment.ml" ~noticed_by:"environment/test_environment"
        [
          ( "late vehicles are remembered for join=1 only",
            {|At_most _ -> noted|},
            {|At_most 1 -> noted | At_most _|} );
          ("a question gets its first answers only", {|(times name counted) (n - 1)|}, {|0 (n - 1)|});
        ];
      in_file "lib/environment/environment.ml" ~noticed_by:"explore/test_verdicts"
        [
          ("each input is certain", {|input.certain) (pending|}, {|true) (pending|});
        ];
      in_file "lib/explore/encoding/encoding.ml" ~noticed_by:"reduction/test_told_apart"
        [
          ( "the encoding where a task begins is not canonical",
            {|  let (c : Configuration.t), outside = t.canonical c outside in
  match|},
            {|  let (c : Configuration.t), outside =
    match c.Configuration.control with Executing _ -> (c, outside) | _ -> t.canonical c outside
  in
  match|} );
        ];
      in_file "lib/explore/encoding/layouts.ml" ~noticed_by:"explore/test_counts"
        [
          ("spare bits are worth a word", {|widths <= words |||}, {|widths <= words + 1 |||});
        ];
      in_file "lib/explore/encoding/portable.ml" ~noticed_by:"explore/test_successors"
        [
          ("states lack the name of their shared part", {|(shared_name t above)|}, {|(shared_name t 0)|});
          ("each part of a state has number 0", {|memoised members name|}, {|memoised members 0|});
        ];
      in_file "lib/explore/order/footprint.ml" ~noticed_by:"reduction/test_traps"
        [
          ( "patterns test nothing",
            {|  | Builtin (Values_of | Poll []), [ e ] -> (|},
            {|  | Builtin Values_of, _ -> breaking
  | Builtin (Poll []), [ e ] -> (|} );
          ( "keys that are computed touch nothing",
            {|Option.fold ~none:anything ~some:f (pairs|},
            {|Option.fold ~none:breaking ~some:f (pairs|} );
        ];
      in_file "lib/explore/order/step_footprints.ml" ~noticed_by:"reduction/test_traps"
        [
          ("ends of tasks leave no trace outside", {|Environment.endings_remember c.options|}, {|false|});
          ( "the last of several parts does not do what they ensure",
            {|if may_finish step then union last f|},
            {|if may_finish step && false then union last f|} );
          ( "a branch that runs first may hold a vehicle",
            {|  | Sequence (r, _) | All_of (Some r, _) -> first_branches c around r|},
            {|  | Sequence (r, _) | All_of (Some r, _) -> first_branches c around r
  | Hold (_, r) when not (is_settled c r) -> first_branches c around r|} );
          ( "the start of a task has no footprint",
            {|Start (_, v), _ -> turning c v|},
            {|Start _, _ -> Footprint.empty|} );
          ( "the end of a task on a held vehicle has no footprint",
            {|{ (turning c v) with remembered|},
            {|{ Footprint.empty with remembered|} );
        ];
      in_file "lib/explore/order/stubborn.ml" ~noticed_by:"reduction/test_traps"
        [
          ("nothing becomes possible later", {|~possible:(surely_moves t x k) own|}, {|~possible:true own|});
        ];
      in_file "lib/explore/steps/expansion.ml" ~noticed_by:"reduction/test_traps"
        [
          ( "the script goes on from one image only",
            {|List.iter image (Task_group.orbit_of_shared g shared)|},
            {|image (List.hd (Task_group.orbit_of_shared g shared))|} );
        ];
      in_file "lib/explore/steps/memoised_steps.ml" ~noticed_by:"explore/test_agreement"
        [
          ( "steps are remembered without the ensured deeds around them",
            {|(number_owed t owed, held|},
            {|(min 1 (number_owed t owed), held|} );
        ];
      in_file "lib/explore/steps/recruiting.ml" ~noticed_by:"reduction/test_told_apart"
        [
          ( "recruits side by side have the same vehicles in all orders",
            {|turn = Hashtbl.length t.turns|},
            {|turn = 0|} );
        ];
      in_file "lib/explore/steps/space.ml" ~noticed_by:"explore/test_bitstate"
        [
          ("components are not hashed", {|f (Layout.local layout key i)|}, {|ignore (Layout.local layout key i)|});
        ];
      in_file "lib/explore/symmetry/alike_values.ml" ~noticed_by:"reduction/test_alike_values"
        [
          ( "the task of an error names no plan",
            {|function 1 -> Other | _ -> Text|},
            {|function 1 | 2 -> Other | _ -> Text|} );
          ( "a text of a value is posted",
            {|code.posted <- Keys.add k code.posted
        | Text | Task -> raise Looked_at|},
            {|code.posted <- Keys.add k code.posted
        | Text -> code.posted <- Keys.add k code.posted
        | Task -> raise Looked_at|} );
          ( "globals keep nothing",
            {|Set_global (_, e) -> nothing code e|},
            {|Set_global (_, e) -> ignore (value_of code e); Other|} );
        ];
      in_file "lib/explore/symmetry/later_picks.ml" ~noticed_by:"environment/test_environment"
        [
          ("nothing follows a break", {|| Break -> exits.break|}, {|| Break -> false|});
        ];
      in_file "lib/explore/symmetry/name_flow.ml" ~noticed_by:"reduction/test_told_apart"
        [
          ("code that makes a task gets no vehicles", {|(fun _ -> taken)|}, {|(fun _ -> taken land text)|});
        ];
      in_file "lib/explore/symmetry/name_flow.ml" ~noticed_by:"reduction/test_traps"
        [
          ( "keys are not passed on by posts",
            {|Posted | Variable _ -> has key k|},
            {|Posted -> false | Variable _ -> has key k|} );
        ];
      in_file "lib/explore/symmetry/task_groups.ml" ~noticed_by:"reduction/test_traps"
        [
          ("each N has a group of its own", {|constant = constant footprint shared|}, {|constant = shared|});
        ];
      in_file "lib/explore/symmetry/vehicle_orbits.ml" ~noticed_by:"reduction/test_told_apart"
        [
          ("places do not matter", {|if_read flow.places|}, {|if_read false|});
          ("values of sensors do not matter", {|if_read flow.sensors|}, {|if_read false|});
          ("payloads do not matter", {|s.kind, s.payload, s.connected|}, {|s.kind, s.connected|});
        ];
      in_file "lib/explore/temporal/observer.ml" ~noticed_by:"explore/test_transition_system"
        [
          ( "checks are silent actions",
            {|label = named; effects|},
            {|label = (match named with Check _ -> Silent | label -> label); effects|} );
          ( "an action without an ending is not observed",
            {|let of_event observer ?ending label = seen observer|},
            {|let of_event observer ?ending label = seen (if ending = None then None else observer)|} );
        ];
      in_file "lib/explore/verdict/fair_cycles.ml" ~noticed_by:"explore/test_fairness"
        [
          ( "all of the repeat that goes on is renewed",
            {|begins_with (repeat @ [ Space.inside ]) at) renewed|},
            {|begins_with [] at && repeat <> []) renewed|} );
          ( "the first vehicle alone decides whether a recruit is owed",
            {|may_all_stay_away system key vs|},
            {|may_all_stay_away system key [ List.hd vs ]|} );
          ( "strong fairness owes failures",
            {|| Some (Vehicle_done _) -> true | Some _ -> false

|},
            {|| Some _ -> true

|} );
          ( "strong fairness ignores that steps were left out",
            {|if steps <> [] && not t.whole|},
            {|if steps <> [] && t.whole|} );
        ];
      in_file "lib/explore/verdict/fair_cycles.ml" ~noticed_by:"explore/test_looks"
        [
          ( "strong fairness leaves out runs in no time",
            {|if active = [] && not t.strong then None|},
            {|if active = [] then None|} );
          ( "readings change without time",
            {|~time:(may_pass found e) moment|},
            {|~time:(may_pass found e || i >= 0) moment|} );
        ];
      in_file "lib/explore/verdict/looks.ml" ~noticed_by:"explore/test_looks"
        [
          ( "of two moments the one that knows more is kept",
            {|List.exists (fun other -> knows_less other way) ways|},
            {|List.exists (fun other -> knows_less way other) ways|} );
        ];
      in_file "lib/explore/verdict/moment_search.ml" ~noticed_by:"explore/test_looks"
        [
          ("dates go back", {|Claim (text, holds) -> Sensor|}, {|Claim (text, holds) -> text = "" && Sensor|});
          ( "waiting shows nothing of the date",
            {|(List.map once_time_has_passed (idle program world c moment))|},
            {|(List.map (fun _ -> once_time_has_passed moment) (idle program world c moment))|} );
          ( "no time passes before an event",
            {|(each (once_time_has_passed pair.moment :: later))|},
            {|(each (pair.moment :: later))|} );
        ];
      in_file "lib/ltl/cycles.ml" ~noticed_by:"ltl/test_ltl"
        [
          ( "a node with an edge to itself is on no cycle",
            {|Stack.push { root with met; is_cycle = true } roots|},
            {|Stack.push { root with met; is_cycle = root.from < place } roots|} );
        ];
      in_file "lib/explore/verdict/search.ml" ~noticed_by:"explore/test_looks"
        [
          ( "runs whose looks contradict each other are shown",
            {|not (Moment_search.agrees program world (fst start) steps)|},
            {|steps = [] && not (Moment_search.agrees program world (fst start) steps)|} );
        ];
      in_file "lib/explore/verdict/search.ml" ~noticed_by:"explore/test_agreement"
        [
          ("files of states stay open", {|State_graph.close graph) (fun|}, {|ignore graph) (fun|});
        ];
      in_file "lib/explore/verdict/transition_system.ml" ~noticed_by:"explore/test_transition_system"
        [
          ( "states have the numbers that processes gave them",
            {|      numbers.(id) <- !known;
      ids.(!known) <- id;
      incr known|},
            {|      numbers.(id) <- id;
      ids.(id) <- id;
      incr known|} );
        ];
      in_file "lib/geo/rims.ml" ~noticed_by:"geo/test_fence"
        [
          ("sides of rims are only in their lowest band", {|band empty w.box.high|}, {|band empty w.box.low|});
        ];
      in_file "lib/geo/search_pattern.ml" ~noticed_by:"geo/test_search_pattern"
        [
          ("the triangles of a sector overlap", {|at 240.; at 300.;|}, {|at 180.; at 240.;|});
        ];
      in_file "lib/maps/feature.ml" ~noticed_by:"maps/test_maps"
        [
          ("milliseconds are cut off", {|Float.round (seconds|}, {|Float.floor (seconds|});
        ];
      in_file "lib/maps/geojson_file.ml" ~noticed_by:"maps/test_maps"
        [
          ("features count from 0", {|"feature %d%s" (i + 1)|}, {|"feature %d%s" i|});
        ];
      in_file "lib/maps/map_file.ml" ~noticed_by:"maps/test_maps"
        [
          ("only the first polygon counts", {|(List.map polygon rings)|}, {|[ polygon (List.hd rings) ]|});
          ("holes are filled", {|~holes:(List.map opened holes)|}, {|~holes:[]|});
        ];
      in_file "lib/maps/map_text.ml" ~noticed_by:"maps/test_maps"
        [
          ("quotes in tables stay alone", {|String.concat "\"\""|}, {|String.concat "\""|});
          ("routes before way points", {|point_of; route_of|}, {|route_of; point_of|});
        ];
      in_file "lib/maps/qgc_plan_file.ml" ~noticed_by:"maps/test_maps"
        [
          ("local frames are on the globe", {|global_frames = [ 0;|}, {|global_frames = [ 0; 1;|});
        ];
      in_file "lib/maps/xml_text.ml" ~noticed_by:"maps/test_maps"
        [
          ( "the place of a fault has its line twice",
            {|place = line }|},
            {|place = "line " ^ string_of_int (fst (Xmlm.pos input)) }|} );
        ];
      in_file "lib/plans/mission_plan.ml" ~noticed_by:"plan/test_mission"
        [
          ("photos need no camera", {|"captureUntilStop" ]|}, {|"captureUntilstop" ]|});
        ];
      in_file "lib/plans/plan_room.ml" ~noticed_by:"runtime/test_runtime"
        [
          ( "the way to a plan needs no room",
            {|parts_of_legs from (Inline_plan.path ~from:here ~speed:1. p)|},
            {|anywhere p|} );
        ];
      in_file "lib/platform_sim/simulated_execution.ml" ~noticed_by:"platform_sim/test_fleet"
        [
          ("divers fly", {|(Depth | Height) -> Some (Float.min 0.)|}, {|(Depth | Height) -> Some Fun.id|});
          ("planes dive", {|"UAV", Depth -> None|}, {|"UAV", Depth -> Some Fun.id|});
        ];
      in_file "lib/platform_sim/track.ml" ~noticed_by:"platform_sim/test_track"
        [
          ( "depths are left to the next place",
            {|Float.max moves_until (Profile.still_from profile)|},
            {|moves_until|} );
        ];
      in_file "lib/processes/workers.ml" ~noticed_by:"processes/test_workers"
        [
          ("a partial write is repeated", {|Unix.single_write|}, {|Unix.write|});
          ("each process computes all", {|from (n + jobs)|}, {|from (n + min jobs 1)|});
          ( "processes heed Ctrl-C",
            {|Sys.Signal_ignore) [ Sys.sigint; Sys.sighup; Sys.sigxfsz ]|},
            {|Sys.Signal_default) [ Sys.sigint ]|} );
        ];
      in_file "lib/platform_sim/reconstruction.ml" ~noticed_by:"trace/test_rest"
        [ ("a resumed fleet reports old places again", {|{ state with progress = [] }|}, {|state|}) ];
      in_file "lib/runtime/driver.ml" ~noticed_by:"runtime/test_runtime"
        [
          ("the date is that of the start", {|(Exactly (World.whole s.moment))|}, {|(Exactly (World.whole 0.))|});
        ];
      in_file "lib/runtime/vehicle_progress.ml" ~noticed_by:"trace/test_rest"
        [
          ( "a rest counts from the beginning",
            {|begun = Option.value begun ~default:0.|},
            {|begun = 0. *. Option.value begun ~default:0.|} );
          ("plans before the latest are forgotten", {|*. of_part))) :: v.earlier|}, {|*. of_part))) :: []|});
          ("a plan that is done is not", {|{ vehicle with begun = 1.; under_way|}, {|{ vehicle with under_way|});
          ("a lost link is a place", {|if vehicle.under_way && s.connected then|}, {|if vehicle.under_way then|});
        ];
      in_file "lib/scenario/battery.ml" ~noticed_by:"time/test_missions"
        [
          ("rest takes nothing", {|at_rest = 0.25|}, {|at_rest = 0.|});
          ("plans that charge drain", {|Charges share -> share /. hour|}, {|Charges _ -> under_way v|});
        ];
      in_file "lib/semantics/elaboration/calls.ml" ~noticed_by:"semantics/test_language"
        [
          ("confirm takes any answer", {|expression env at (While (open_, again))|}, {|again|});
        ];
      in_file "lib/semantics/language/rest.ml" ~noticed_by:"trace/test_rest"
        [ ("the rest of a rest is cut as the whole is", {|(share -. begun) /. (1. -. begun)|}, {|share|}) ];
      in_file "lib/semantics/language/dated_code.ml" ~noticed_by:"time/test_exact"
        [
          ( "a date turns as it is passed",
            {|reached = int_of_float (Float.ceil x)|},
            {|reached = int_of_float (Float.ceil x) + 1|} );
          ( "a variable has the value that was assigned last",
            {|Hashtbl.find_all c.assigned i|},
            {|Option.to_list (Hashtbl.find_opt c.assigned i)|} );
          ( "midnight passes unseen",
            {|let times = 0 :: List.filter|},
            {|let times = List.filter|} );
          ( "a time of day comes once",
            {|let again k = n + 1 + remainder (k - n - 1) in|},
            {|let again k = k in|} );
          ( "comparisons count as arithmetic",
            {|Binary (Add | Subtract | Multiply | Divide)), es)|},
            {|Binary (Add | Subtract | Multiply | Divide | Greater)), es)|} );
        ];
      in_file "lib/semantics/language/machine.ml" ~noticed_by:"semantics/test_language"
        [
          ( "an unknown value is false in an if",
            {|| _, _ -> needs context u locals stack calls at)|},
            {|| _, _ -> evaluate context fuel no locals stack calls)|} );
        ];
      in_file "lib/semantics/language/operators.ml" ~noticed_by:"semantics/test_vector"
        [
          ("lists are copied for each element", {|(Vector.get xs) i|}, {|(Array.get (Vector.to_array xs)) i|});
        ];
      in_file "lib/semantics/language/procedures.ml" ~noticed_by:"semantics/test_language"
        [
          ("every picked vehicle runs", {|Vehicle_map.mem v.id context.allocation|}, {|List.mem v.id context.bound|});
        ];
      in_file "lib/semantics/language/travel.ml" ~noticed_by:"plan/test_travel"
        [
          ("plans of one name are one plan", {|(spell (Number rest))|}, {|p.name|});
        ];
      in_file "lib/semantics/language/unknown.ml" ~noticed_by:"semantics/test_language"
        [
          ( "any of unknown ones is known",
            {|| (Any | Every | Sum), Some u -> Ok (Some (Unknown u))|},
            {|| (Any | Every | Sum), Some _ -> Ok None|} );
          ("unknown values are posted", {|Builtin (Message|}, {|Builtin (Post _ | Message|});
        ];
      in_file "lib/semantics/rules/branches.ml" ~noticed_by:"semantics/test_branches"
        [
          ("branches that come keep the marks of those that went", {|~some:unmark }|}, {|~some:(fun _ -> index) }|});
        ];
      in_file "lib/semantics/rules/local_step.ml" ~noticed_by:"semantics/test_rules"
        [
          ("a made task takes vehicles that others hold", {|(from free)|}, {|(from bound)|});
        ];
      in_file "lib/semantics/rules/maker.ml" ~noticed_by:"semantics/test_rules"
        [
          ("tasks side by side have the same keys", {|ns, numbers = split|}, {|ns, _ = split|});
        ];
      in_file "lib/semantics/rules/run_code.ml" ~noticed_by:"semantics/test_rules"
        [
          ( "code that is faulty has effects",
            {|| Faulted fault -> Faulty (fault, said deeds)|},
            {|| Faulted fault -> Halts (fault.message, after context s, deeds)|} );
          ( "messages of faulty code are lost",
            {|| Faulted fault -> Faulty (fault, said deeds)|},
            {|| Faulted fault -> Faulty (fault, [])|} );
        ];
      in_file "lib/semantics/rules/script_rules.ml" ~noticed_by:"semantics/test_invariants"
        [
          ( "an interruption does not release whom a task recruited",
            {|| None -> Conclusion.ending ~waits ~recruits [|},
            {|| None -> Conclusion.ending ~waits ~recruits:[] [|} );
        ];
      in_file "lib/semantics/rules/task_rules.ml" ~noticed_by:"semantics/test_invariants"
        [
          ("PAR-2 ends all", {|Rule.Par_2 (Next (without place))|}, {|Rule.Par_2 Finished|});
        ];
      in_file "lib/semantics/rules/task_rules.ml" ~noticed_by:"semantics/test_rules"
        [
          ( "ALLOF-2 forgets the other branches",
            {|Rule.Allof_2 (Next (all_of None remaining))|},
            {|Rule.Allof_2 Finished|} );
          ( "WATCH-IGNORE goes on with the error",
            {|Rule.Watch_ignore Finished|},
            {|Rule.Watch_ignore (Failed fault)|} );
          ( "WATCH-PROPAGATE ignores the error",
            {|Rule.Watch_propagate (Failed fault)|},
            {|Rule.Watch_propagate Finished|} );
          ( "WATCH-RETRY drops the watch",
            {|Next (Watch (Unallocated { task; request }, handler))|},
            {|Next (Unallocated { task; request })|} );
          ( "a round counts twice",
            {|Option.map pred again.left|},
            {|Option.map (fun n -> max 0 (n - 2)) again.left|} );
          ("ASSURE-CUT ends as done", {|(Failed (Fault.make site (not_assured condition)))|}, {|Finished|});
          ("HOLD-1 forgets the held vehicles", {|~next:(within (Holding vs))|}, {|~next:Fun.id|});
          ("WITHIN-CUT ends as done", {|Failed (Fault.make site (too_late duration))|}, {|Finished|});
          ( "ONEOF-WHEN does not begin its body",
            {|enter label enters around b.body|},
            {|change label enters (Next (around b.body))|} );
          ("CONFIRM-NO ends as done", {|(failed (Printf.sprintf "'%s' was answered no" prompt))|}, {|Finished|});
        ];
      in_file "lib/semantics/terms/tuple_space.ml" ~noticed_by:"tuple_space/test_tuple_space"
        [
          ("the newest pair is consumed", {|min_binding queue|}, {|max_binding queue|});
        ];
      in_file "lib/semantics/terms/vector.ml" ~noticed_by:"semantics/test_vector"
        [
          ("a copy has no room", {|(max least_room (2 * xs.length))|}, {|(xs.length + 1)|});
        ];
      in_file "lib/syntax/prelude.dol" ~noticed_by:"prelude/test_prelude"
        [
          ("atLeast accepts one less", {|count((done): _) >= k|}, {|count((done): _) >= k - 1|});
          ( "a barrier holds no task",
            {|condition { count((name): { it == 'came' }) == n }|},
            {|condition { count((name): _) >= 1 }|} );
          ("a follower reads one end several times", {|consume((name): 'done')|}, {|poll((name): 'done')|});
          ("the goal of a failed vehicle is lost", {|post((goal): g, (out): 1)|}, {|post((out): 1)|});
          ("a vehicle at exactly the distance is not near", {|<= d }|}, {|< d }|});
        ];
      in_file "lib/time/batteries.ml" ~noticed_by:"time/test_exact"
        [
          ( "a vehicle that is stopped goes on",
            {|if doing = Clocked.doing options before vehicle then None|},
            {|if doing = Rests || Clocked.doing options before vehicle <> Rests then None|} );
        ];
      in_file "lib/time/canonical_state.ml" ~noticed_by:"time/test_reductions"
        [
          ("plans of any time are alike", {|Milliseconds (least, most)|}, {|Milliseconds (0, 0)|});
        ];
      in_file "lib/time/clocked.ml" ~noticed_by:"time/test_exact"
        [
          ("code reads no date", {|Since s.date|}, {|Since 0|});
          ( "a lost link is noticed at once",
            {|Within { least; _ } -> Within { least; most }|},
            {|Within _ -> Within { least = 0; most }|} );
          ("an order does not wait for the link", {|[ task Ordered;|}, {|[ task Under_way;|});
          ("a silent link is waited for without end", {|(List.to_seq (given_up o world s))|}, {|Seq.empty|});
        ];
      in_file "lib/time/course.ml" ~noticed_by:"time/test_missions"
        [
          ( "the last known charge counts as the present one",
            {|Links.may_go (Durations.links_with faults c.options.durations)|},
            {|Links.may_go (Links.only_first (Durations.links_with faults c.options.durations))|} );
        ];
      in_file "lib/time/levels.ml" ~noticed_by:"time/test_exact"
        [
          ( "rest charges for as long as it may last",
            {|(after rate least k.low)|},
            {|(after rate (Option.value most ~default:least) k.low)|} );
          ( "work takes its shortest time",
            {|Some ms -> after rate ms k.low|},
            {|Some ms -> after rate (min ms least) k.low|} );
        ];
      in_file "lib/time/longest.ml" ~noticed_by:"time/test_exact"
        [
          ( "the first way is taken for the longest",
            {|if way > longest.(w)|},
            {|if longest.(w) < 0 && way > longest.(w)|} );
        ];
      in_file "lib/time/share_out.ml" ~noticed_by:"time/test_workers"
        [
          ( "an interruption is a lack of time",
            {|Limits.Stop bound -> (found, Some bound)|},
            {|Limits.Stop _ -> (found, Some Limits.Time)|} );
          ("the other processes are left alone", {|~finally:(fun () -> Workers.stop workers)|}, {|~finally:ignore|});
        ];
      in_file "lib/time/slack.ml" ~noticed_by:"time/test_missions"
        [
          ("a task may take a millisecond too much", {|= 1 then kept|}, {|= 1 then later|});
          ("a task that is cut off counts with all its time", {|| None -> Some Any|}, {|| None -> Some (By 0)|});
        ];
      in_file "lib/time/timed_analysis.ml" ~noticed_by:"time/test_exact"
        [
          ( "plans side by side are those by their order alone",
            {|      | candidates, None -> pairs |},
            {|      | candidates, None -> (fun (_, stopped) -> (candidates, stopped)) @@ pairs |} );
        ];
      in_file "lib/time/timed_analysis.ml" ~noticed_by:"time/test_missions"
        [
          ("slacks of other tasks", {|(tasks.(i), slack)|}, {|(tasks.(count - 1 - i), slack)|});
        ];
      in_file "lib/time/timed_system.ml" ~noticed_by:"time/test_exact"
        [
          ( "states include those that they do not",
            {|List.find_opt (fun m -> Zone.subset zone t.nodes.(m).zone) place.here in|},
            {|List.find_opt (fun _ -> true) place.here in|} );
          ( "states stand for others that they do not include",
            {|Zone.subset (seen other.zone) zone then begin|},
            {|(ignore (Zone.subset (seen other.zone) zone); true) then begin|} );
          ( "moves to included states lead no further",
            {|Included_in m -> standing_for t m ||},
            {|Included_in m when m < 0 -> standing_for t m | Included_in _ ||} );
          ("dates are forgotten", {|Latest -> Zone.reaching_down|}, {|Latest -> Zone.at_any_date|});
        ];
      in_file "lib/time/unread_pairs.ml" ~noticed_by:"time/test_exact"
        [
          ("what is polled is not read", {|(Poll keys | Consume keys)|}, {|(Consume keys)|});
        ];
      in_file "lib/time/unread_pairs.ml" ~noticed_by:"time/test_reductions"
        [
          ("what is counted is not read", {|(Poll [] | Values_of), [|}, {|(Poll []), [|});
        ];
      in_file "lib/time/working.ml" ~noticed_by:"time/test_exact"
        [
          ("inert ends take nothing", {|Some (task.vehicle, p.most)|}, {|Some (task.vehicle, 0)|});
        ];
      in_file "lib/time/inert.ml" ~noticed_by:"time/test_reductions"
        [
          ( "an action that others see is part of an inert sequence",
            {|Action code, _ when does_nothing i code|},
            {|Action code, _ when (ignore (does_nothing i code); true)|} );
          ( "a handler that may be called is left out",
            {|let never_fails i r = not (Step_footprints.of_residual i.steps r).breaks|},
            {|let never_fails i r = ignore (Step_footprints.of_residual i.steps r); true|} );
        ];
      in_file "lib/time/clocked.ml" ~noticed_by:"time/test_missions"
        [
          ( "each way of a sequence begins where the first does",
            {|(moved_by Whereabouts.after here p) ~default:here, |},
            {|(Option.map (fun _ -> here) (moved_by Whereabouts.after here p)) ~default:here, |} );
        ];
      in_file "lib/time/working.ml" ~noticed_by:"time/test_missions"
        [
          ( "the bound counts orders that wait as work",
            {|| Ordered, _ -> None|},
            {|| Ordered, _ -> Some (v, since)|} );
        ];
      in_file "lib/time/zone.ml" ~noticed_by:"time/test_zone"
        [
          ( "a bound is not carried over to other clocks",
            {|let by = before + c ++ get z b j in|},
            {|let by = if i = a || j = b then before + c ++ get z b j else unbounded in|} );
          ("a new clock has the value of the date", {|None -> zero in|}, {|None -> date in|});
        ];
      in_file "lib/time/zone_node.ml" ~noticed_by:"time/test_exact"
        [
          ( "nothing has to happen",
            {|List.fold_left limit (Some (Zone.delay zone)) (snd (follow t place))|},
            {|Some (Zone.delay zone)|} );
          ( "steps are taken too early",
            {|Zone.at_least clock least zone in|},
            {|Zone.at_least clock (min 0 least) zone in|} );
          ("waits share clocks that began apart", {|Some other -> is_function && Int.equal mine other|},
           {|Some _ -> is_function|});
        ];
      in_file "lib/time/zone_node.ml" ~noticed_by:"time/test_reductions"
        [
          ( "the rest is over though not all of it is",
            {|    let* zone = Option.bind zone (Zone.at_most clock (-i.least)) in|},
            {|    let* zone = if last = None then zone else Option.bind zone (Zone.at_most clock (-i.least)) in|} );
          ("the last end of the rest may come too late", {|(-i.most) zone|}, {|(-i.most - 1_000) zone|});
          ("of steps that lead to alike states only one is noticed", {|step.urgent, what,|}, {|step.urgent, (),|});
        ];
      in_file "lib/time/whereabouts.ml" ~noticed_by:"time/test_recorded"
        [
          ( "a way that is cut ends in the middle",
            {|then here else around here places)|},
            {|then here else { (around here places) with within = 0. })|} );
          ( "a circle is its centre",
            {|= Position.equal p' q' then 0. else here.within in|},
            {|= Position.equal p' q' then 0. else 0. in|} );
          ("home is one place", {|(Some centre) then here else None|}, {|(Some centre) then Some (at centre) else None|});
        ];
    ]
