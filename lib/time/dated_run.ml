open Dolphin_semantics

type t = {
  options : Clocked.options;
  tolerance : int;
  state : Clocked.state;
  began : (Clocked.item * int) list;
  told : Clocked.item list;  (* of the late events *)
  silent : Core.vehicle list;  (* whose links are *)
  ordered : Core.vehicle list;  (* whose orders wait for the link *)
  back : (Core.vehicle * int) list;  (* since when there is a link again *)
}

type finding = { pending : Clocked.pending; at : Core.site option; began : int; seen : int; too_early : bool }

(* A run itself records the news of its vehicles. *)
let start ~tolerance (options : Clocked.options) =
  let options = { options with durations = { options.durations with links = Links.none } } in
  let state = Clocked.initial options in
  let began = List.map (fun (p : Clocked.pending) -> (p.item, 0)) state.pending in
  { options; tolerance; state; began; told = []; silent = []; ordered = []; back = [] }

let onwards (r : t) ~outside ~date ~seen =
  let began item = Option.value (List.assoc_opt item r.began) ~default:0 in
  (r.options, Clocked.onwards r.options r.state ~outside ~now:date ~began ~seen)

let running (r : t) =
  let of_pending (p : Clocked.pending) =
    match p.item, p.progress with
    | Task v, Under_way when not (List.mem v r.ordered) -> Some (p, List.assoc p.item r.began)
    | _, _ -> None
  in
  List.filter_map of_pending r.state.pending

let with_tolerance tolerance r = { r with tolerance }

(* {1 Links} *)

let less v = List.filter (fun w -> not (String.equal v w))

let heard (r : t) ~date v connected =
  match connected, List.mem v r.silent with
  | true, true ->
    let again (item, began) = (item, if item = Clocked.Task v && List.mem v r.ordered then date else began) in
    { r with silent = less v r.silent; ordered = less v r.ordered; began = List.map again r.began;
             back = (v, date) :: List.remove_assoc v r.back }
  | false, false -> { r with silent = v :: r.silent }
  | true, false | false, true -> r

(* When a task that is over by [date] is heard to be, at the latest; never while nothing is heard. *)
let heard_by (r : t) (item : Clocked.item) date =
  match item with
  | Task v when List.mem v r.silent -> max_int
  | Task v -> max date (Option.value (List.assoc_opt v r.back) ~default:0)
  | _ -> date

(* {1 Transitions} *)

(* People and suppliers take their time, and post when they like. *)
let is_timed (p : Clocked.pending) =
  match p.item with
  | Task _ | Timer _ -> true
  | Question _ | Recruit _ | Answer | Reply | Posting _ | Links | Silence _ | Course _ | Date _ -> false

let is_lost = String.starts_with ~prefix:Dolphin_environment.Environment.loss

(* Whether [item] must have ended by its bounds, and may not have ended before them. *)
let judged (on : Transition.event option) (item : Clocked.item) =
  match on, item with
  | Some (Vehicle_failed (v, why)), Task v' when v = v' -> (not (is_lost why), false)
  | Some (Vehicle_done v), Task v' when v = v' -> (true, true)
  | Some (Timer_expired i), Timer i' when i = i' -> (true, true)
  | _, _ -> (true, false)

let compare_with (r : t) ~date ~on (p : Clocked.pending) =
  let began = List.assoc p.item r.began in
  let must_be_over, must_have_run = judged on p.item in
  let finding too_early = Some { pending = p; at = Clocked.site r.state p.item; began; seen = date; too_early } in
  match p.bounds with
  | Within { most; _ } when must_be_over && date - r.tolerance > heard_by r p.item (began + most) -> finding false
  | Within { least; _ } when must_have_run && date - began < least - r.tolerance -> finding true
  | Within _ | Some_time | Never -> None

let transition (r : t) ~date ~on t =
  let is_new (p : Clocked.pending) = is_timed p && not (List.mem p.item r.told) in
  let found = List.filter_map (compare_with r ~date ~on) (List.filter is_new r.state.pending) in
  let step = Clocked.taken r.options r.state ~on t in
  let begins (p : Clocked.pending) =
    (p.item, if List.mem p.item step.fresh then date else List.assoc p.item r.began) in
  let is_still item =
    (not (List.mem item step.fresh)) && List.exists (fun (p : Clocked.pending) -> p.item = item) step.next.pending in
  let told = List.filter is_still (List.map (fun f -> f.pending.item) found @ r.told) in
  let ordered : Effect.t -> _ = function Start (v, _) when List.mem v r.silent -> Some v | _ -> None in
  let ordered = List.filter_map ordered step.transition.effects in
  ({ r with state = step.next; began = List.map begins step.next.pending; told; ordered = ordered @ r.ordered }, found)
