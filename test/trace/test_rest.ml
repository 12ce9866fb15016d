(* A plan that is stopped goes on where it stopped: the simulated vehicle goes the way of the plan, once. *)

open Dolphin_geo
open Dolphin_trace

(* {1 Programs} *)

(* It is stopped after each of [stops], in seconds, one start after the other. The program keeps the whole plan, or the
   part of it that is left. *)
type mission = { plan : string; keeps_rest : bool; stops : int list }

let maneuver =
  let open QCheck2.Gen in
  let metres = int_range (-200) 200 in
  oneof
    [ map2 (Printf.sprintf "move(%d, %d); goTo()") metres metres;
      map (Printf.sprintf "skeeping duration: %d") (int_range 1 200);
      map (Printf.sprintf "loiter duration: %d") (int_range 1 200);
      map2 (Printf.sprintf "move(40, 0); rows width: %d, length: %d, hstep: 30") (int_range 40 120) (int_range 50 200) ]

let mission =
  let open QCheck2.Gen in
  let* maneuvers = list_size (int_range 1 5) maneuver in
  let* stops = list_size (int_range 1 3) (int_range 1 600) in
  let plan =
    Printf.sprintf "imcPlan { planName 'way'; speed 2, Speed.Units.METERS_PS; locate 41.185, -8.707; goTo(); %s }"
      (String.concat "; " maneuvers)
  in
  let* keeps_rest = bool in
  return { plan; keeps_rest; stops }

let program m ~stops =
  let rest = if m.keeps_rest then "way = way.rest(v)\nexecute way[v]" else "execute way.rest(v)[v]" in
  let stopped seconds = Printf.sprintf "%s during %d\nexecute away[v]\n" rest seconds in
  Printf.sprintf
    "v = pick { id 'auv' }\nway = %s\naway = imcPlan { speed 2, Speed.Units.METERS_PS; locate 41.187, -8.708; goTo() \
     }\n%s%s\n"
    m.plan
    (String.concat "" (List.map stopped stops))
    rest

(* {1 The way gone} *)

(* A part of the plan, from its first place on: the way there is another one in each run. *)
type part = { first : Position.t; is_there : bool; samples : (float * Position.t) list  (* the latest first *) }

let metres_there = 3.

let sample part (time, p) =
  let is_there = part.is_there || Wgs84.distance p part.first <= metres_there in
  { part with is_there; samples = (if is_there then (time, p) :: part.samples else part.samples) }

let parts journal =
  let add (under_way, parts) line =
    match Entry.of_string line, under_way, parts with
    | Ok (Vehicle { time; state }), true, part :: earlier -> (true, sample part (time, state.position) :: earlier)
    | Ok (Transition { step; ways = [ (_, Path (_ :: first :: _)) ]; _ }), _, _ when step.label = "start(auv, way)" ->
      (true, { first; is_there = false; samples = [] } :: parts)
    | Ok (Transition { step = { allocated = [ (_, None) ]; _ }; _ }), _, _ -> (false, parts)
    | (Ok _ | Error _), _, _ -> (under_way, parts)
  in
  List.rev_map (fun part -> List.rev part.samples) (snd (List.fold_left add (false, []) (Runs.lines journal)))

let rec metres = function (_, p) :: ((_, q) :: _ as rest) -> Wgs84.distance p q +. metres rest | [ _ ] | [] -> 0.

let seconds = function
  | [] -> 0.
  | (first, _) :: _ as samples -> fst (List.nth samples (List.length samples - 1)) -. first

let sum f parts = List.fold_left (fun total part -> total +. f part) 0. parts

let fleet =
  match Dolphin_scenario.Scenario.read ~file:"rest.fleet" "vehicle 'auv', { type 'UUV'; at 41.186, -8.706; drain 0 }" with
  | Ok scenario -> scenario
  | Error _ -> failwith "rest.fleet"

let run source = Runs.of_scenario ~period:0. fleet source

(* Between two reports are a second, and so 2 metres: that much of each part may be gone twice. *)
let goes_the_way_once m =
  let journal = (run (program m ~stops:m.stops)).journal and whole = (run (program m ~stops:[])).journal in
  let broken = parts journal and whole = parts whole in
  let n = float_of_int (List.length m.stops) in
  let near what least most x =
    if least <= x && x <= most then true
    else QCheck2.Test.fail_reportf "%s: %g, not from %g to %g\n%s" what x least most (program m ~stops:m.stops)
  in
  let samples = List.concat broken in
  let nearest (_, p) = List.fold_left (fun d (_, q) -> Float.min d (Wgs84.distance p q)) infinity samples in
  near "metres gone" (sum metres whole -. (4. *. n) -. 4.) (sum metres whole +. (8. *. n) +. 4.) (sum metres broken)
  && near "seconds" (sum seconds whole -. (4. *. n) -. 4.) (sum seconds whole +. (5. *. n) +. 4.) (sum seconds broken)
  && List.for_all (fun place -> near "metres off a place of the way" 0. 6. (nearest place)) (List.concat whole)

(* {1 Resuming} *)

(* Stays that are left are rounded up to whole seconds, for each stop. *)
let most_late = 5.

let goes_on_the_same (m, line) =
  let r = run (program m ~stops:m.stops) in
  let lines = Runs.lines r.journal in
  let kept = List.filteri (fun i _ -> i < 1 + (line mod (List.length lines - 1))) lines in
  match Runs.resume r (Runs.text kept) with
  | Error why -> QCheck2.Test.fail_reportf "not resumed: %s" why
  | Ok resumed ->
    let ends journal =
      List.filter_map
        (fun line -> match Entry.of_string line with
           | Ok (Event { time; event }) -> Some (time, event)
           | Ok _ | Error _ -> None)
        (Runs.lines journal) in
    let same (time, event) (time', event') = event = event' && Float.abs (time -. time') <= most_late in
    let times journal =
      String.concat " " (List.map (fun (time, _) -> Printf.sprintf "%.1f" time) (ends journal)) in
    List.equal same (ends resumed) (ends r.journal)
    || QCheck2.Test.fail_reportf "after %d lines it ends at %s, not at %s" (List.length kept) (times resumed)
      (times r.journal)

(* {1 Reports} *)

(* A report that the link is lost, or a resumed run's first one, has an earlier place. *)
let lost_link () =
  let module Progress = Dolphin_runtime.Vehicle_progress in
  let module Plans = Dolphin_plans in
  let place north = Wgs84.displace Place.apdl ~north ~east:0. in
  let item word arguments = { Plans.Mission_plan.word; arguments } in
  let go north = item "goPos" [ ("position", Plans.Mission_plan.Place (place north)) ] in
  let stay = item "loiterTime" [ ("position", Place (place 100.)); ("duration", Number 60.) ] in
  let plan = Plans.Inline_plan.Mission { name = "way"; vehicles = []; items = [ go 0.; go 100.; stay ] } in
  let vehicle ?(connected = true) north =
    { Dolphin_semantics.World.id = "auv"; kind = "UAV"; payload = []; position = place north; depth = None;
      altitude = None; battery = None; speed = None; readings = []; connected; unready = None; cruise = Some 2.;
      drain = None; progress = [] }
  in
  let see x (time, state) = fst (Progress.see ~at:time state x) in
  let begun = Progress.start (vehicle 0.) { name = "way"; plan = Some plan; task_site = 0 } Progress.none in
  let reports = List.init 41 (fun second -> (float_of_int second, vehicle (2. *. float_of_int second))) in
  let seen = List.fold_left see begun reports in
  let share ~at x state = List.map snd (snd (Progress.see ~at state x)).progress in
  let shares = Alcotest.(list (float 0.01)) in
  Alcotest.check shares "without a link" [ 80. /. 160. ] (share ~at:55. seen (vehicle ~connected:false 80.));
  let later = see seen (42., vehicle ~connected:false 80.) in
  Alcotest.check shares "with a link again" [ 86. /. 160. ] (share ~at:43. later (vehicle 86.))

let print m = program m ~stops:m.stops

let () =
  Alcotest.run "rest"
    [ ( "random",
        [ Test_support.Property.case "the way of the plan is gone once" ~count:100 mission ~print goes_the_way_once;
          Test_support.Property.case "a resumed run goes on at the same place" ~count:50
            QCheck2.Gen.(pair mission (int_range 0 100_000))
            ~print:(fun (m, line) -> Printf.sprintf "%s# line %d" (print m) line)
            goes_on_the_same ] );
      ("reports", [ Alcotest.test_case "a lost link is not a place" `Quick lost_link ]) ]
