open Dolphin_runtime
open Dolphin_semantics
open Dolphin_trace
open Lwt.Infix
module Simulator = Dolphin_platform_sim.Simulator
module Scenario_world = Dolphin_environment.Scenario_world

(* Each transition with its cause, as the configuration before it has it. *)
let steps (program : Core.program) (witness : Witness.t) transitions =
  let caused (c, made) (step : Witness.step) (transition : Transition.t) =
    let cause =
      match step.cause with
      | Choice _ -> None
      | Event event -> Result.to_option (Event.to_event program c event)
    in
    (transition.next, { Enactment.cause; transition } :: made)
  in
  let all = witness.steps @ witness.cycle in
  List.rev (snd (List.fold_left2 caused (Configuration.initial program, []) all transitions))

let header (program : Program_file.t) fleet ~speed : Header.t =
  { program = Program_file.header program; fleet = Fleet_file.header fleet; platform = "sim";
    order = Simulator.Virtual.order; seed = 0; speed; started = Recording.utc_now (); run = None;
    fences = Dolphin_plans.Fences.list program.program.fences;
    place = program.program.place;
    begins = program.program.begins }

let enact (front : Run.front) recording ~interruption ~speed (program : Program_file.t) (fleet : Fleet_file.t) steps =
  let observer = 
    let unasked () = Interruption.is_unasked interruption in
    Observer.both (Recording.observer recording ~unasked) front.observer in
  let on (type p) (module P : Platform.S with type t = p) (platform : p) =
    front.opened
      { now = (fun () -> P.now platform); estimates = (fun () -> []); post = (fun _ _ -> Lwt.return_false);
        questions = (fun () -> []); replace = Replacement.refused; acted = (fun _ -> Ok ()) };
    Enactment.run (module P) platform ~observer ~interruption:(Interruption.promise interruption)
      ~giving_up:(Interruption.unasked interruption) program.program steps
    >|= fun outcome -> (P.now platform, outcome)
  in
  let seed = 0 and scenario = fleet.scenario in
  match speed with
  | None -> on (module Simulator.Virtual) (Simulator.Virtual.create ~seed scenario)
  | Some speed -> on (module Simulator.Paced) (Simulator.Paced.create ~speed ~seed scenario)

let ( let*? ) result f = match result with Ok x -> f x | Error _ as error -> Lwt.return error

let misfit (program : Program_file.t) (_, { Witness.number; why }) =
  Error.Bad_input (Printf.sprintf "%s has no such run: step %d: %s" program.path number why)

let start (front : Run.front) ~interruption ~speed ~follower program (fleet : Fleet_file.t) (witness : Witness.t) =
  let core = program.Program_file.program in
  let*? taken, cycle =
    Result.map_error (misfit program) (Witness.follow core (Scenario_world.world fleet.scenario) witness) in
  let settings = { Recording.nothing with follower = Some follower } in
  let*? recording = Recording.start settings (header program fleet ~speed) core in
  let run () =
    let*? () = Recording.begin_ recording in
    enact front recording ~interruption ~speed program fleet (steps core witness (taken @ cycle))
    >|= fun (time, outcome) ->
    let stuck = match outcome with Driver.Stuck _ | Spins _ -> true | Ended _ -> false in
    if cycle <> [] then front.remark "from here the run repeats without end";
    Result.map (fun () -> outcome) (Recording.finish recording ~time ~stuck)
  in
  Lwt.finalize run (fun () -> Recording.close recording; Lwt.return_unit)
