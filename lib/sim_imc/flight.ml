open Dolphin_platform_sim
open Dolphin_plans
open Dolphin_semantics

type maneuver = { id : string; kind : int; ends : float }
type t = { execution : Simulated_execution.t; maneuvers : maneuver list }

let task name plan : Core.platform_task =
  { name; plan = Option.map (fun p -> Inline_plan.Maneuvers p) plan; task_site = 0 }

(* Each maneuver as an execution of its own, from the end of the one before. *)
let maneuvers ~draw vehicle position (s : Specification.t) =
  let add (position, time, maneuvers) (m : Plan.maneuver) kind =
    let one = task s.plan.name (Some { s.plan with maneuvers = [ m ] }) in
    let execution = Simulated_execution.make ~draw None vehicle position one in
    let ends = time +. execution.duration in
    Track.position execution.track execution.duration, ends, { id = m.id; kind; ends } :: maneuvers
  in
  let _, _, maneuvers = List.fold_left2 add (position, 0., []) s.plan.maneuvers s.kinds in
  List.rev maneuvers

let make ~draw plan vehicle position ~name (specification : Specification.t option) =
  match specification with
  | Some s -> { execution = Simulated_execution.make ~draw plan vehicle position (task name (Some s.plan));
                maneuvers = maneuvers ~draw vehicle position s }
  | None ->
    let execution = Simulated_execution.make ~draw plan vehicle position (task name None) in
    { execution; maneuvers = [ { id = "1"; kind = Dolphin_imc.Message.Goto.id; ends = execution.duration } ] }

let rec at time = function
  | [ last ] -> last
  | maneuver :: (_ :: _ as rest) -> if time < maneuver.ends then maneuver else at time rest
  | [] -> { id = ""; kind = 65535; ends = infinity }

let maneuver f time = at time f.maneuvers

let rec ends_with maneuver = function
  | [ last ] -> last == maneuver
  | _ :: (_ :: _ as rest) -> ends_with maneuver rest
  | [] -> true

let is_last f maneuver = ends_with maneuver f.maneuvers

let statistics ~name f : Dolphin_imc.Message.Plan_statistics.t =
  let _, durations =
    List.fold_left
      (fun (start, texts) { id; ends; kind = _ } ->
         ends, Printf.sprintf "Maneuver %s=%.1f" id (ends -. start) :: texts)
      (0., []) f.maneuvers
  in
  let total = List.fold_left (fun _ maneuver -> maneuver.ends) 0. f.maneuvers in
  let whole = Printf.sprintf "Total=%.1f,Execution=%.1f,Calibration=0.0" total total in
  { Dolphin_imc.Message.Plan_statistics.default with
    plan_id = name;
    properties = Dolphin_imc.Message.Plan_statistics.Properties.(if total = Stdlib.infinity then infinite else basic);
    durations = (if total = infinity then "" else String.concat "," (whole :: List.rev durations)) }
