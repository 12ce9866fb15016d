open Dolphin_semantics
open Test_support
module Place = Dolphin_geo.Place

let case name run = Alcotest.test_case name `Quick run
let uuv = Pure_run.vehicle "noptilus-1"

(* 2 m/s, and a tenth of its battery in an hour. *)
let able = { uuv with cruise = Some 2.; drain = Some 0.1 }
let silent = { uuv with cruise = None; drain = None }

let describe world source =
  let program = Pure_run.compile_exn ("v = pick { type 'UUV' }\n" ^ source) in
  let run = Pure_run.run ~world program in
  match Pure_run.ending run with "completed" -> String.concat "; " (Pure_run.said run) | ending -> ending

let says name ?(of_vehicle = able) expected source =
  let check () = Alcotest.(check string) name expected (describe (Pure_run.world [ of_vehicle ]) source) in
  case name check

(* 600 m east of the vehicle: 600 m there, then 150 m in two legs and a minute's stay. *)
let lane ?(speed = "") () =
  Printf.sprintf
    {|start = position(v).displace(0, 600)
      lane = imcPlan { planName 'lane'; %s; locate start; goTo(); move 100, 0; goTo(); move 0, 50
        skeeping duration: 1.minute }
      |}
    speed

let rpm = "speed 1000, 'rpm'"
let in_metres = "speed 1.5, Speed.Units.METERS_PS"
let asked = {|message "${lane.length.round()} ${lane.length(v).round()} ${lane.duration(v).round()} ${lane.energy(v).round(5)}"|}

let by_hand =
  [
    says "at the vehicle's speed" "150 750 435 0.01208" (lane ~speed:rpm () ^ asked);
    says "at the plan's speed" "150 750 560 0.01556" (lane ~speed:in_metres () ^ asked);
    says "a vehicle that tells nothing" ~of_vehicle:silent "150 750 unknown unknown" (lane ~speed:rpm () ^ asked);
    says "a speed in m/s is enough for durations" ~of_vehicle:silent "150 750 560 unknown"
      (lane ~speed:in_metres () ^ asked);
    says "a battery that does not tell what it gives" ~of_vehicle:{ able with drain = None } "150 750 560 unknown"
      (lane ~speed:in_metres () ^ asked);
    says "eta" "300" "message eta(v, position(v).displace(0, 600)).round()";
    says "eta of a vehicle that tells nothing" ~of_vehicle:silent "unknown" "message eta(v, Location.APDL)";
    says "a guard that is unknown does not hold" ~of_vehicle:silent "late"
      {|execute during 1.second run waitFor { eta(v, Location.APDL) < 1e9 } then action { message 'there' }
        message 'late'|};
    says "a plan by name" "unknown" "message imcPlan('survey').duration(v)";
    says "a mission" "250 850 425"
      {|there = position(v).displace(0, 600)
        m = mission { arm: true; takeOff 30; goPos there; move 100, 0; move 0, 150 }
        message "${m.length.round()} ${m.length(v).round()} ${m.duration(v).round()}"|};
    says "a way that depends on its beginning"
      "failed: the way of plan 'plan-2' depends on its start: write length(v), with its vehicle"
      "m = mission { move 100, 0; returnHome() }\nmessage m.length";
    says "a plan without end" "failed: plan 'plan-2' goes on until it is stopped: its length is unknown"
      "m = imcPlan { locate Location.APDL; goTo(); skeeping duration: 0 }\nmessage m.duration(v)";
    says "the length of a plan by name"
      "failed: the way of plan 'survey' is not described here: only its vehicle knows it" "message imcPlan('survey').length";
    says "of two vehicles" "failed: the set must be a single vehicle, it has 0"
      "m = imcPlan { locate Location.APDL; goTo() }\nmessage m.duration(v - v)";
    says "of no vehicle" "failed: a task has no method 'duration' for 1 arguments of that kind"
      "m = imcPlan { locate Location.APDL; goTo() }\nmessage m.duration(3)";
  ]

(* {1 Where a vehicle may be anywhere} *)

let anywhere = World.open_position "noptilus-1" [] (Pure_run.world [ able ])

let said_of world source =
  let program = Pure_run.compile_exn ("v = pick { type 'UUV' }\n" ^ source) in
  match Dolphin_explore.Reference.explore Dolphin_environment.Environment.default program world with
  | None -> Alcotest.fail "too many states"
  | Some graph ->
    let label ((t : Transition.t), _) = Format.asprintf "%a" Label.pp t.label in
    List.sort_uniq String.compare (List.concat_map (List.map label) (Array.to_list graph.edges))

let contains part text =
  let n = String.length part in
  let rec at i = i + n <= String.length text && (String.sub text i n = part || at (i + 1)) in
  at 0

let finds name world ~some ~none source =
  let check () =
    let found = said_of world source in
    let is_there part = List.exists (contains part) found in
    List.iter (fun part -> if not (is_there part) then Alcotest.failf "no %s in %s" part (String.concat ", " found)) some;
    List.iter (fun part -> if is_there part then Alcotest.failf "%s in %s" part (String.concat ", " found)) none
  in
  case name check

let either = [ "'long'"; "'short'" ]
let fixed = "p = imcPlan { planName 'p'; speed 2; locate Location.APDL; goTo(); move 100, 0; goTo() }\n"
let long_or_short what = fixed ^ "if (" ^ what ^ ") { message 'long' } else { message 'short' }"

let open_places =
  [
    finds "a duration is open" anywhere ~some:either ~none:[] (long_or_short "p.duration(v) > 1.hour");
    finds "an eta is open" anywhere ~some:either ~none:[] (long_or_short "eta(v, Location.APDL) > 1.hour");
    finds "an energy is open" anywhere ~some:either ~none:[] (long_or_short "battery(v) - p.energy(v) > 0.3");
    finds "its length is not" anywhere ~some:[ "'long'" ] ~none:[ "'short'" ] (long_or_short "p.length > 99");
    finds "one comparison has one outcome in one step" anywhere ~some:[ "'short'" ] ~none:[ "'long'" ]
      (long_or_short "p.duration(v) > 9 && p.duration(v) <= 9");
    (* Plans of one name are two plans. *)
    finds "other plans are compared anew" anywhere ~some:either ~none:[]
      (fixed
       ^ {|q = imcPlan { planName 'p'; speed 2; locate Location.APDL; goTo(); move 900, 0; goTo() }
           if (p.duration(v) <= 9 && q.duration(v) > 9) { message 'long' } else { message 'short' }|});
    finds "missions that return are compared too" anywhere ~some:either ~none:[]
      "p = mission { move 100, 0; returnHome() }\nif (p.duration(v) > 9) { message 'long' } else { message 'short' }";
    finds "what the fleet gives is computed"
      (World.open_position "noptilus-1" [ Place.apdl; Place.feup ] (Pure_run.world [ able ]))
      ~some:either ~none:[]
      (long_or_short "p.duration(v) > 51");
    finds "and nothing else"
      (World.open_position "noptilus-1" [ Place.apdl; Place.feup ] (Pure_run.world [ able ]))
      ~some:[ "'short'" ] ~none:[ "'long'" ]
      (long_or_short "p.duration(v) > 5.hours");
  ]

let () = Alcotest.run "travel" [ ("by hand", by_hand); ("open places", open_places) ]
