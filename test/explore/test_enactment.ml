(* Any run of a random program is carried out on the simulated fleet as it is given, step by step: time never goes
   back, nothing runs at the end, and the run ends with the ending of its last step. *)

open Dolphin_semantics
open Dolphin_runtime
module Scenario = Dolphin_scenario.Scenario
module Fleet = Dolphin_platform_sim.Simulator.Virtual
module Generate = Test_support.Generate
module Pure_run = Test_support.Pure_run
module Walk = Test_support.Walk
module Witness = Dolphin_trace.Witness
module Event = Dolphin_trace.Event

let scenario text =
  match Scenario.read ~file:"test.fleet" text with Ok s -> s | Error _ -> failwith "the fleet has faults"

let fleet = scenario "vehicle 'a', { type 'UUV' }\nvehicle 'b', { type 'UUV' }\nvehicle 'c', { type 'UAV' }\n"

(* Each transition of a run with its cause. *)
let steps program world transitions =
  let initial = Configuration.initial program in
  let caused c (step : Witness.step) : Transition.event option =
    match step.cause with
    | Choice _ -> None
    | Event event -> Result.to_option (Event.to_event program c event)
  in
  let step (c, made) cause (transition : Transition.t) =
    (transition.next, { Enactment.cause = caused c cause; transition } :: made) in
  List.rev
    (snd (List.fold_left2 step (initial, []) (Witness.steps program world initial transitions) transitions))

type told = { time : float; label : string }

let enact ?(interruption = fst (Lwt.wait ())) scenario program steps =
  let platform = Fleet.create ~seed:0 scenario in
  let told = ref [] in
  let transition ~time ~cause:_ (t : Transition.t) =
    told := { time; label = Format.asprintf "%a" Label.pp t.label } :: !told in
  let observer = { Observer.nobody with transition } in
  let outcome = Lwt_main.run (Enactment.run (module Fleet) platform ~observer ~interruption program steps) in
  let idle (v : Scenario.vehicle) = Fleet.running platform v.id = None in
  (outcome, List.rev !told, List.for_all idle scenario.vehicles)

let label (s : Enactment.step) = Format.asprintf "%a" Label.pp s.transition.label

let rec ascending = function
  | a :: (b :: _ as rest) -> a.time <= b.time && ascending rest
  | [ _ ] | [] -> true

let as_given (ast, choices) =
  let program = Generate.compile ast in
  let taken = List.map (fun (s : Walk.step) -> s.transition) (Walk.run ~choices program Generate.world) in
  let given = steps program Generate.world taken in
  let outcome, told, idle = enact fleet program given in
  let n = List.length given in
  let first = List.filteri (fun i _ -> i < n) told and others = List.filteri (fun i _ -> i >= n) told in
  List.map (fun t -> t.label) first = List.map label given
  && List.for_all (fun t -> t.label = "interrupt") others
  && ascending told && idle
  &&
  match Pure_run.last taken, (outcome : Driver.outcome) with
  | Some { control = Ended ending; _ }, Ended ending' -> others = [] && Configuration.compare_ending ending ending' = 0
  | Some { control = Ended _; _ }, (Stuck _ | Spins _) -> false
  | (Some _ | None), (Ended Interrupted | Stuck _) -> true
  | (Some _ | None), (Ended (Completed | Halted _ | Failed _) | Spins _) -> false

(* {1 When} *)

let times = Alcotest.(list (pair string (float 0.001)))

(* The plan that takes longer ends first: the other one takes as long, then. *)
let held_back () =
  let program = Pure_run.compile_exn "v = pick { count 2 }\nexecute task('short') | task('long')\n" in
  let scenario =
    scenario
      "vehicle 'a', { type 'UUV' }\nvehicle 'b', { type 'UUV' }\nplan 'short', { duration 1.min }\n\
       plan 'long', { duration 9.min }\n" in
  let world = Pure_run.world [ Pure_run.vehicle "a"; Pure_run.vehicle "b" ] in
  let rec run c taken =
    let own, events = Pure_run.successors program world c in
    let wanted (t : Transition.t) = match t.label with Done (_, "long") -> true | _ -> false in
    match own, List.find_opt wanted events, events with
    | t :: _, _, _ | [], Some t, _ | [], None, t :: _ -> run t.next (t :: taken)
    | [], None, [] -> List.rev taken
  in
  let given = steps program world (run (Configuration.initial program) []) in
  let _, told, _ = enact scenario program given in
  let ends t = match String.index_opt t.label '(' with Some i -> String.sub t.label 0 i = "done" | None -> false in
  Alcotest.check times "ends" [ ("done(b, long)", 540.); ("done(a, short)", 540.) ]
    (List.map (fun t -> (t.label, t.time)) (List.filter ends told))

let interrupted () =
  let program = Pure_run.compile_exn "v = pick { count 1 }\nexecute task('p')\n" in
  let given = steps program Generate.world (Pure_run.run ~world:Generate.world program) in
  let outcome, told, idle = enact ~interruption:Lwt.return_unit fleet program given in
  Alcotest.(check bool) "is interrupted" true (outcome = Driver.Ended Interrupted);
  Alcotest.(check (list string)) "before anything" [ "interrupt" ] (List.map (fun t -> t.label) told);
  Alcotest.(check bool) "nothing runs" true idle

let () =
  let print (ast, _) = Generate.print ast in
  Alcotest.run "enactment"
    [ ("random", [ Test_support.Property.case ~count:300 "as it is given" ~print
                     QCheck2.Gen.(pair Generate.program Walk.choices) as_given ]);
      ("time", [ Alcotest.test_case "held back" `Quick held_back; Alcotest.test_case "interrupted" `Quick interrupted ])
    ]
