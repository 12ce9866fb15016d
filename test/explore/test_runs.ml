(* Every run on the simulated fleet lies within the explored graph of the same program in the same world: of all
   examples, and of random programs with random fleets; and so does every run whose sensors show anything at each
   step. The graph is followed along the run, by the explorer's possible transitions: a transition of the run must be
   among those, with the same label and the same result. PROGRAMS in the environment is how many programs are tried
   of each kind, 300 by default. *)

open Dolphin_plans
open Dolphin_semantics
open Dolphin_runtime
open Dolphin_environment
module Scenario = Dolphin_scenario.Scenario
module Simulator = Dolphin_platform_sim.Simulator
module Generate = Test_support.Generate
module Answering = Test_support.Answering
module Calls = Test_support.Calls

(* {1 Runs} *)

(* The simulated fleet, kept to fences, in the explorer's words of failures. *)
module Platform = struct
  include Fenced.Make (Simulator.Virtual)

  let begins prefix text =
    String.length text >= String.length prefix && String.sub text 0 (String.length prefix) = prefix

  let next p =
    let translate : Dolphin_runtime.Platform.event -> Dolphin_runtime.Platform.event = function
      | Task_failed (v, why) ->
        Task_failed (v, if begins "connection lost" why then Environment.loss else Environment.failure)
      | (Vehicle _ | Task_done _ | Timer _ | Input _ | Quiet) as event -> event
    in
    Lwt.map translate (next p)

  let create ~seed fences scenario =
    make (Fence_guard.make fences) ~untold:[] (Simulator.Virtual.create ~seed scenario)
end

(* The number of transitions that are enough for a run without end. *)
let most_steps = 400

exception Enough

let run ?(until = infinity) ~seed scenario (program : Core.program) =
  let taken = ref [] and left = ref most_steps in
  let transition ~time ~cause:_ (t : Transition.t) =
    if !left = 0 || time > until then raise Enough;
    decr left;
    match t.label with Interrupt -> left := 0 | _ -> taken := t :: !taken
  in
  let platform = Platform.create ~seed program.fences scenario in
  let observer : Observer.t = { Observer.nobody with transition } in
  let whole () =
    Driver.run (module Platform) platform ~observer ~host:(Answering.host scenario)
      ~console:(Answering.console scenario)
      ~interruption:(fst (Lwt.wait ())) { program with fences = Fences.none }
  in
  (match Lwt_main.run (whole ()) with Ended _ | Stuck _ | Spins _ -> () | exception Enough -> ());
  List.rev !taken

(* {1 The graph} *)

let no_plan : Dolphin_plans.Plan.t = { name = ""; description = ""; vehicles = []; maneuvers = [] }

(* The explorer knows no rest of a plan, only that it is one. *)
let some_rest (p : Core.platform_task) =
  match p.plan with
  | Some (Rest r) -> { p with plan = Some (Rest { r with share = None; plan = Maneuvers no_plan }) }
  | Some (Maneuvers _ | Mission _) | None -> p

(* A plan of which nothing is done yet is its rest. *)
let whole (p : Core.platform_task) =
  match p.plan with Some plan -> some_rest { p with plan = Some (Dolphin_plans.Inline_plan.some_rest plan) } | None -> p

let rec of_task : Core.task -> Core.task = function
  | Platform p -> Platform (whole p)
  | t -> Task.map { part = of_task; code = of_code; value = of_value; vehicle = Fun.id } t

and of_code (c : Core.closure) = { c with captured = Array.map of_value c.captured }

and of_value : Core.value -> Core.value = function
  | Task t -> Task (of_task t)
  | Closure c -> Closure (of_code c)
  | List xs -> List (Vector.map of_value xs)
  | Map entries -> Map (List.map (fun (k, x) -> (k, of_value x)) entries)
  | x -> x

let rec of_residual : Residual.t -> Residual.t = function
  | Ready (p, v) -> Ready (whole p, v)
  | Running (p, v) -> Running (whole p, v)
  | r ->
    Residual.map
      { part = of_residual; code = of_code; handler = of_code; maker = of_code; value = of_value; term = of_task;
        vehicle = Fun.id }
      r

(* A global that holds what a sensor has shown: the explorer knows no more of it. *)
let same_store (found : Store.t) (store : Store.t) =
  let same (i, x) (i', x') =
    i = i' && (Reading.is_reading x || Value.compare x x' = 0 || Value.compare (of_value x) (of_value x') = 0) in
  let found = Store.bindings found and store = Store.bindings store in
  List.compare_lengths found store = 0 && List.for_all2 same found store

let same_tuples found tuples =
  let pairs tuples =
    List.map (fun (k, xs) -> (k, List.sort Value.compare (List.map of_value xs))) (Tuples.bindings tuples) in
  let same (k, xs) (k', xs') = String.equal k k' && List.equal (fun x y -> Value.compare x y = 0) xs xs' in
  Tuples.compare found tuples = 0 || List.equal same (pairs found) (pairs tuples)

(* Messages of the explorer speak of vehicles and sensors as it knows them, and so do machines. *)
let same_control ~senses (found : Configuration.control) (control : Configuration.control) =
  match found, control with
  | Ended (Failed f), Ended (Failed f') -> f.site = f'.site
  | Ended (Halted _), Ended (Halted _) -> true
  | Script m, Script m' -> Machine.compare m m' = 0 || (senses && Machine.site m = Machine.site m')
  | Waiting (m, request), Waiting (m', request') ->
    (Machine.compare m m' = 0 || (senses && Machine.site m = Machine.site m'))
    && Machine.compare_request request request' = 0
  | Executing (m, r), Executing (m', r') ->
    (Machine.compare m m' = 0 || (senses && Machine.site m = Machine.site m'))
    && (Residual.equal r r' || Residual.equal (of_residual r) (of_residual r'))
  | Ended e, Ended e' -> Configuration.compare_ending e e' = 0
  | (Script _ | Waiting _ | Executing _ | Ended _), _ -> false

let same_configuration ~senses (found : Configuration.t) (c : Configuration.t) =
  same_control ~senses found.control c.control
  && same_store found.shared.store c.shared.store
  && Vehicle_map.equal (fun (p : Core.platform_task) p' -> p.name = p'.name) found.shared.allocation c.shared.allocation
  && found.shared.bound = c.shared.bound
  && same_tuples found.shared.tuples c.shared.tuples

let same_label ~senses (found : Label.t) (label : Label.t) =
  match found, label with
  | No_vehicles _, No_vehicles _ | Cannot_execute _, Cannot_execute _ | Fault _, Fault _ -> true
  | (Did (Said _) | Halt _), (Did (Said _) | Halt _) when senses -> true
  | (Act ds, Act ds' | Check ds, Check ds' | Cut ds, Cut ds') when senses -> List.compare_lengths ds ds' = 0
  | _, _ -> Label.equal found label

let unsettled = ref 0

let follow options program world taken =
  let senses = program.Core.reads_sensors || program.reads_now in
  let step (number, states) (t : Transition.t) =
    let leads ((t' : Transition.t), e) =
      if same_label ~senses t'.label t.label && same_configuration ~senses t'.next t.next then Some (t'.next, e)
      else None
    in
    let after (c, e) = List.of_seq (Seq.filter_map leads (Environment.choices options program world e c)) in
    let distinct found (c, e) =
      let same (c', e') = Configuration.equal c c' && Environment.compare e e' = 0 in
      if List.exists same found then found else (c, e) :: found
    in
    match List.fold_left distinct [] (List.concat_map after states) with
    | [] ->
      let offered (c, e) =
        List.map
          (fun ((t : Transition.t), _) -> Format.asprintf "%a" Label.pp t.label)
          (List.of_seq (Environment.choices options program world e c))
      in
      let offered = String.concat ", " (List.concat_map offered states) in
      failwith (Format.asprintf "step %d, %a, is not explored; there are: %s" number Label.pp t.label offered)
    | states -> (number + 1, states)
  in
  let start = (Configuration.initial program, Environment.initial) in
  (* Exploring stops where outcomes cannot be listed. *)
  let rec go (number, states) = function
    | [] -> number
    | t :: taken -> (
        match step (number, states) t with
        | next -> go next taken
        | exception Environment.Unclear _ -> incr unsettled; number)
  in
  go (1, [ start ]) taken - 1

let is_unsteady (v : Scenario.vehicle) = v.joins > 0. || v.leaves <> None || v.drops <> []

(* Links come and go by the fleet only; nor do batteries run empty elsewhere, which makes tasks fail. *)
let environment program (scenario : Scenario.t) =
  let is_drained (v : Scenario.vehicle) = v.drain > 1. in
  let where is_so : Faults.limit = if List.exists is_so scenario.vehicles then Any_number else Never in
  let faults : Faults.t =
    { Faults.none with fail = where is_drained; loss = where is_unsteady; join = where is_unsteady }
  in
  Scenario_world.environment ~answers:[] ~faults program scenario

let steps = ref 0

let is_explored ?until ~seed scenario program =
  let taken = run ?until ~seed scenario program in
  steps := !steps + follow (environment program scenario) program (Scenario_world.world scenario) taken

(* {1 Examples} *)

let folder = Test_support.Examples.folder

let contents path =
  let channel = open_in_bin path in
  Fun.protect ~finally:(fun () -> close_in channel) (fun () -> really_input_string channel (in_channel_length channel))

let examples = Test_support.Examples.names ()

let example name =
  let check () =
    let file ending = Filename.concat folder (name ^ ending) in
    match Scenario.read ~file:name (contents (file ".fleet")) with
    | Error _ -> Alcotest.fail "the fleet is wrong"
    | Ok scenario ->
      let program = Test_support.Pure_run.compile_exn ?place:scenario.plans_at (contents (file ".dol")) in
      let program = { program with begins = scenario.begins } in
      List.iter (fun seed -> is_explored ~seed scenario program) [ 0; 1; 2; 3; 4 ]
  in
  Alcotest.test_case name `Quick check

(* {1 Random programs} *)

let fleet =
  let open QCheck2.Gen in
  let time = map float_of_int (int_range 1 200) in
  let vehicle id kind north =
    let* joins = frequency [ (3, return 0.); (1, time) ]
    and* stay = frequency [ (4, return None); (1, map Option.some time) ] in
    let* drops = frequency [ (3, return []); (1, map2 (fun from lasts -> [ { Scenario.from; lasts } ]) time time) ] in
    let* batteries = frequencyl [ (1, []); (1, [ 1.; 0.2 ]) ] in
    let first = List.hd Scenario.default.vehicles in
    let position = (Test_support.Pure_run.vehicle ~north id).position in
    let leaves = Option.map (fun stay -> joins +. stay) stay in
    return { first with id; kind; position; joins; leaves; drops; batteries; payload = [] }
  in
  let plan name =
    let* least = time and* more = time in
    let* ending = oneofl [ Scenario.Succeeds; Succeeds; May_fail 0.5; Fails ] in
    let* only = frequencyl [ (4, []); (1, [ "UUV" ]) ] in
    let* charges = frequencyl [ (2, None); (1, Some 12.) ] in
    return { Scenario.name; duration = Some { least; most = least +. more }; ending; place = None; only; charges }
  in
  let* steady = bool in
  let steadily (v : Scenario.vehicle) = if steady then { v with joins = 0.; leaves = None; drops = [] } else v in
  (* With this drain sensors show a change. *)
  let* drain = oneofl [ 0.1; 12. ] in
  let draining (v : Scenario.vehicle) = { v with drain } in
  let* vehicles = flatten_l [ vehicle "a" "UUV" 0.; vehicle "b" "UUV" 100.; vehicle "c" "UAV" 200. ] in
  let* plans = flatten_l [ plan "p"; plan "q" ] in
  let* yes_or_no = oneofl [ [ "yes" ]; [ "no" ]; [ "y"; "n" ] ] in
  let go i : Scenario.answer = { prompt = Printf.sprintf "go %d?" i; texts = yes_or_no } in
  let answers = { Scenario.prompt = "how many?"; texts = [ "1"; "2" ] } :: List.init 3 go in
  let reply call : Scenario.reply = { call; rounds = Calls.replies call } in
  let replies = List.map reply Calls.names in
  let vehicles = List.map (fun v -> draining (steadily v)) vehicles in
  return { Scenario.vehicles; plans; answers; replies; inputs = []; samples = []; fences = []; plans_at = None;
           recurrences = []; begins = None; zone = None }

let random_case =
  QCheck2.Gen.(
    triple
      (oneof [ Generate.program; Generate.sensing_program; Calls.within Generate.program ])
      fleet (int_bound 1_000))

let print (ast, scenario, seed) =
  Format.asprintf "seed %d@.%a@.%s" seed Scenario.pp scenario (Generate.print ast)

(* Before this, in seconds, no battery runs empty that has 20 % and loses 10 % in an hour. *)
let until = 7_000.

let random_runs (ast, scenario, seed) =
  is_explored ~until ~seed scenario (Generate.compile ast);
  true

(* {1 Sensors that show anything} *)

(* Sensor values in [Generate.open_world] at one time, by three numbers; some of the plans [begun] are done. *)
let world_at ~begun (x, y, z) =
  let progress share = List.map (fun whole -> (whole, share)) begun in
  let place north = (Test_support.Pure_run.vehicle ~north "a").position in
  let show (s : World.vehicle_state) =
    match s.id with
    | "a" -> { s with battery = Some x; position = place (1_000. *. y); progress = progress z }
    | "b" ->
      { s with battery = Some (if z < 0.5 then 1. else 0.2); position = place (1_000. *. x); progress = progress y }
    | _ ->
      { s with battery = Some y; position = place (if x < 0.5 then 200. else 5_000.);
               progress = progress (if y < 0.5 then 0. else 0.5) }
  in
  List.fold_left (fun world s -> World.add (show s) world) World.empty (World.vehicles Generate.world)

let options =
  { Environment.default with
    answers = (fun _ -> [ [ "1"; "2" ] ]);
    faults = { Faults.none with fail = Any_number; loss = Any_number } }

(* The whole of each plan that runs. *)
let begins begun (c : Configuration.t) =
  let add begun (_, (p : Core.platform_task)) =
    match p.plan with
    | Some plan ->
      let whole = fst (Dolphin_plans.Inline_plan.begun plan) in
      if List.mem whole begun then begun else whole :: begun
    | None -> begun
  in
  List.fold_left add begun (Vehicle_map.bindings c.shared.allocation)

(* At each step sensors have new values, and one of the possible transitions is taken. *)
let walk program choices =
  let step (begun, (c, e), taken) (shown, choice) =
    match List.of_seq (Environment.choices options program (world_at ~begun shown) e c) with
    | [] -> (begun, (c, e), taken)
    | all ->
      let (t : Transition.t), e = List.nth all (choice mod List.length all) in
      (begins begun t.next, (t.next, e), t :: taken)
  in
  let start = (Configuration.initial program, Environment.initial) in
  let _, _, taken = List.fold_left step ([], start, []) choices in
  List.rev taken

let walks =
  let open QCheck2.Gen in
  let share = float_bound_inclusive 1. in
  pair Generate.sensing_program (list_size (int_range 10 40) (pair (triple share share share) (int_bound 1_000)))

let walks_are_explored (ast, choices) =
  let program = Generate.compile ast in
  let taken = walk program choices in
  steps := !steps + follow options program Generate.open_world taken;
  true

let number name default = match Sys.getenv_opt name with Some n -> int_of_string n | None -> default
let count = number "PROGRAMS" 300

let enough () =
  Printf.printf "%d steps; %d unsettled\n" !steps !unsettled;
  if !steps < 5 * count then Alcotest.failf "%d steps are few" !steps

let () =
  Alcotest.run "runs"
    [ ("examples", List.map example examples);
      ( "random programs",
        [ Test_support.Property.case "simulated runs are explored" ~count random_case ~print random_runs;
          Test_support.Property.case "whatever sensors show is explored" ~count walks
            ~print:(fun (ast, _) -> Generate.print ast) walks_are_explored;
          Alcotest.test_case "runs have many steps" `Quick enough ] ) ]
