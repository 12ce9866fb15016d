open Dolphin_results
open Dolphin_semantics
open Dolphin_time
open Dolphin_trace
module Scenario_world = Dolphin_environment.Scenario_world

type given = { program : Core.program; scenario : Dolphin_scenario.Scenario.t }

let options ~faults ~world g : Clocked.options =
  { environment = Scenario_world.environment ~answers:[] ~faults g.program g.scenario; program = g.program;
    world = world g.scenario; durations = Durations.of_scenario g.scenario;
    dates = Dated_code.named g.program }

(* {1 All runs} *)

let most_states = 100_000

let window (w : Timed_analysis.window) : Timed_data.window =
  { earliest = w.earliest; latest = (match w.latest with At n -> Some n | Unbounded -> None) }

let both (a : Timed_data.window) (b : Timed_data.window) : Timed_data.window =
  let latest = match a.latest, b.latest with Some m, Some n -> Some (max m n) | None, _ | _, None -> None in
  { earliest = min a.earliest b.earliest; latest }

(* When a task is stopped depends on the orders that are followed: see docs/time.md. *)
let moments windows =
  let one (moment, w) =
    match (moment : Timed_system.moment) with
    | Starts | Ends | Fails -> Some (Timed_system.moment_name moment, window w)
    | Stopped -> None
  in
  List.sort compare (List.filter_map one windows)

(* Those of one name on one vehicle are one. *)
let add_task tasks ((task : Timed_analysis.task), windows) =
  let is_same (t : Timed_data.task) = t.name = task.name && t.vehicle = task.vehicle in
  let others, before = List.partition (fun t -> not (is_same t)) tasks in
  let known = List.concat_map (fun (t : Timed_data.task) -> t.moments) before in
  let add known (moment, w) =
    match List.assoc_opt moment known with
    | Some w' -> (moment, both w w') :: List.remove_assoc moment known
    | None -> (moment, w) :: known
  in
  let moments = List.sort compare (List.fold_left add known (moments windows)) in
  others @ [ { Timed_data.name = task.name; vehicle = task.vehicle; moments } ]

let line (p : Core.program) site = Dolphin_syntax.Location.line p.locations.(site)

let times ~faults g =
  let limits = { Dolphin_checker.Limits.none with max_states = Some most_states } in
  let o = Timed_analysis.run limits (options ~faults ~world:Scenario_world.world g) in
  if o.stopped <> None then Error "there are too many states, or it is not clear what happens"
  else
    let missed = List.filter_map (fun (site, run) -> Option.map (fun _ -> line g.program site) run) o.deadlines in
    let ends = List.map (fun (e, w) -> (Timed_system.ending_name e, window w)) o.endings in
    let tasks = List.fold_left add_task [] o.tasks and endless = o.endless <> None in
    Ok { Timed_data.ends = List.sort compare ends; tasks; endless; missed = List.sort_uniq compare missed }

(* {1 One run} *)

let most_steps = 10_000

let ended (item : Clocked.item) =
  match item with
  | Task v -> Timed_data.Vehicle v
  | Timer i -> Timer i
  | Question _ | Recruit _ | Answer | Reply | Posting _ | Links | Silence _ | Course _ | Date _ ->
    invalid_arg "Timed_answers: what has no bounds"

let finding (f : Dated_run.finding) : Timed_data.finding =
  { at = f.seen; ended = ended f.pending.item; too = (if f.too_early then "early" else "late") }

let rec in_order before = function [] -> true | (date, _) :: rest -> before <= date && in_order date rest

let dated ~faults g run =
  let options = options ~faults ~world:Scenario_world.still g in
  let world date = World.at (Exactly (date / 1000)) options.world in
  let take (recorded, found, _) date on (t : Transition.t) =
    let recorded, more = Dated_run.transition recorded ~date ~on t in
    (recorded, found @ List.map finding more, t.next)
  in
  let rec by_itself n date ((_, _, c) as at) =
    match (Transition.internal g.program (world date) c) () with
    | Seq.Nil -> Ok at
    | Seq.Cons _ when n = 0 -> Error "it never comes to a wait"
    | Seq.Cons (t, _) -> by_itself (n - 1) date (take at date None t)
  in
  let on_event ((_, _, c) as at) (date, event) =
    let refused : Transition.refusal -> _ = function
      | Not_awaited -> Error (Printf.sprintf "%s at %d is not awaited" (Fmt.to_to_string Event.pp event) date)
      | Bad_answer why -> Error why
    in
    match Event.to_event g.program c event with
    | Error (No_value why) -> Error why
    | Error (Refused refusal) -> refused refusal
    | Ok e -> (
        match Transition.accept g.program (world date) c e with
        | Ok t -> by_itself most_steps date (take at date (Some e) t)
        | Error refusal -> refused refusal)
  in
  let start = (Dated_run.start ~tolerance:0 options, [], Configuration.initial g.program) in
  if not (in_order 0 run) then Error "its dates go back"
  else
    Result.bind (by_itself most_steps 0 start) (fun start ->
        Result.map (fun (_, found, _) -> List.sort compare found) (Results.fold on_event start run))
