open Dolphin_semantics

type moment = Starts | Ends | Fails | Stopped
type task = Canonical_state.label = { name : string; vehicle : Core.vehicle; site : Core.site }

let deadlines (s : Clocked.state) =
  let deadline found (r : Residual.t) =
    match r with During { on_cut = Fails site; timer; started = true; _ } -> (timer, site) :: found | _ -> found in
  match s.configuration.control with
  | Executing (_, r) -> Residual.fold_active deadline [] r
  | Script _ | Waiting _ | Ended _ -> []

let task v (p : Core.platform_task) = { name = p.name; vehicle = v; site = p.task_site }

(* The events of tasks with [step]. *)
let tasks (before : Clocked.state) (step : Clocked.step) =
  let tr = step.transition in
  let running v moment =
    match Vehicle_map.find_opt v before.configuration.shared.allocation with
    | Some p -> [ (moment, task v p) ]
    | None -> []
  in
  let with_effect : Effect.t -> _ = function
    | Start (v, p) -> [ (Starts, task v p) ]
    | Stop v -> running v Stopped
    | _ -> []
  in
  (match tr.label with Done (v, _) -> running v Ends | Fail (v, _, _) -> running v Fails | _ -> [])
  @ List.concat_map with_effect tr.effects

(* The [within] that is missed with [step]. *)
let missed (before : Clocked.state) (step : Clocked.step) =
  match step.due with
  | Some (Timer timer, _) when List.mem Rule.Within_cut step.transition.rules ->
    List.assoc_opt timer (deadlines before)
  | Some _ | None -> None

let task_of_part (p : Inert.part) =
  match p.event, p.task with Task v, Some t -> Some (task v t) | _, _ -> None
