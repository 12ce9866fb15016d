type t = { folder : string; weight : int; tests : string list }

let rules =
  [ "semantics/test_rules"; "semantics/test_language"; "explore/test_verdicts"; "runtime/test_runtime";
    "time/test_missions"; "reduction/test_traps"; "conformance/test_cases"; "conformance/test_oracle";
    "semantics/test_parts"; "prelude/test_prelude"; "semantics/test_branches"; "reduction/test_recruits";
    "semantics/test_invariants"; "semantics/test_laws" ]

let language =
  [ "semantics/test_language"; "semantics/test_rules"; "semantics/test_vector"; "tuple_space/test_tuple_space";
    "semantics/test_plans"; "plan/test_plan_builder"; "plan/test_mission"; "plan/test_travel"; "runtime/test_runtime";
    "conformance/test_cases"; "prelude/test_prelude"; "@test/semantics/runtest" ]

let reductions =
  [ "reduction/test_traps"; "reduction/test_told_apart"; "reduction/test_owned"; "reduction/test_alike_values";
    "reduction/test_recruits"; "reduction/test_picks"; "reduction/test_symmetry"; "reduction/test_agreement" ]

let searches =
  [ "explore/test_verdicts"; "explore/test_counts"; "explore/test_workers"; "explore/test_transition_system";
    "explore/test_bitstate"; "explore/test_runs"; "explore/test_successors"; "explore/test_temporal" ]

let explorer =
  [ "reduction/test_traps"; "explore/test_world"; "reduction/test_told_apart"; "explore/test_looks";
    "explore/test_fairness"; "explore/test_agreement" ] @ searches

let clocks =
  [ "time/test_missions"; "time/test_zone"; "time/test_workers"; "time/test_sampled"; "time/test_recorded";
    "time/test_reductions"; "time/test_exact" ]

let all =
  let row folder weight tests = { folder; weight; tests } in
  [
    row "lib/semantics/rules" 6 rules;
    row "lib/semantics/terms" 2 language;
    row "lib/semantics/language" 3 language;
    row "lib/semantics/elaboration" 1 language;
    row "lib/explore/order" 3 (reductions @ [ "time/test_reductions" ]);
    row "lib/explore/symmetry" 2 reductions;
    row "lib/explore" 3 explorer;
    row "lib/checker" 3 ([ "checker/test_search"; "checker/test_states" ] @ searches);
    row "lib/environment" 2
      [ "explore/test_verdicts"; "environment/test_environment"; "reduction/test_picks"; "time/test_exact" ];
    row "lib/time" 5 clocks;
    row "lib/runtime" 4 [ "runtime/test_runtime"; "explore/test_enactment"; "trace/test_journals"; "resume/test_kills" ];
    row "lib/trace" 2
      [ "trace/test_pictures"; "trace/test_mutants"; "trace/test_journals"; "trace/test_resume"; "trace/test_partial" ];
    row "lib/ltl" 1 [ "ltl/test_ltl"; "explore/test_temporal" ];
    row "lib/lts_json" 1 [ "lts/test_formats"; "lts/test_large" ];
    row "lib/lts" 1 [ "lts/test_formats"; "lts/test_lts"; "lts/test_large" ];
    row "lib/geo" 2
      [ "geo/test_geo"; "geo/test_polyline"; "geo/test_search_pattern"; "geo/test_fence"; "geo/test_parts";
        "geo/test_coverage"; "maps/test_maps" ];
    row "lib/plans" 1 [ "plan/test_plan_path"; "plan/test_mission"; "plan/test_plan_faults"; "runtime/test_runtime" ];
    row "lib/assignment" 1 [ "assignment/test_assignment" ];
    row "lib/scenario" 1 [ "scenario/test_scenario"; "environment/test_environment"; "time/test_missions" ];
    row "lib/platform_sim" 1 [ "platform_sim/test_track"; "platform_sim/test_simulator"; "platform_sim/test_fleet" ];
    row "lib/imc" 1 [ "imc/imc_test"; "platform_imc/platform_imc_test" ];
    row "lib/syntax" 2 [ "syntax/test_syntax"; "semantics/test_language"; "@test/syntax/runtest" ];
    row "lib/maps" 1 [ "maps/test_maps" ];
    row "lib/processes" 1 [ "processes/test_workers"; "time/test_workers" ];
    row "lib/statistics" 1 [ "statistics/test_statistics" ];
  ]

let is_below folder file =
  let folder = folder ^ "/" in
  String.length file > String.length folder && String.equal folder (String.sub file 0 (String.length folder))

let of_file file = List.find_opt (fun row -> is_below row.folder file) all
