open Dolphin_semantics

type t = {
  options : Timed.options;
  tolerance : int;
  state : Timed.state;
  began : (Timed.item * int) list;
  told : Timed.item list;  (* of what is said to be late *)
}

type finding = { pending : Timed.pending; began : int; seen : int; too_early : bool }

let start ~tolerance options =
  let state = Timed.initial options in
  { options; tolerance; state; began = List.map (fun (p : Timed.pending) -> (p.item, 0)) state.pending; told = [] }

let with_tolerance tolerance r = { r with tolerance }

(* People and suppliers take their time, and post when they like; vehicles join when they are heard of. *)
let is_timed (p : Timed.pending) =
  match p.item with
  | Task _ | Timer _ -> true
  | Question _ | Recruit _ | Answer | Reply | Posting _ | Coming _ | Course _ | Date _ -> false

let is_lost = String.starts_with ~prefix:Dolphin_environment.Environment.loss

(* Whether [item] must have ended by its bounds, and may not have ended before them. *)
let judged (on : Transition.event option) (item : Timed.item) =
  match on, item with
  | Some (Vehicle_failed (v, why)), Task v' when v = v' -> (not (is_lost why), false)
  | Some (Vehicle_done v), Task v' when v = v' -> (true, true)
  | Some (Timer_expired i), Timer i' when i = i' -> (true, true)
  | _, _ -> (true, false)

let compare_with (r : t) ~date ~on (p : Timed.pending) =
  let began = List.assoc p.item r.began in
  let must_be_over, must_have_run = judged on p.item in
  let finding too_early = Some { pending = p; began; seen = date; too_early } in
  match p.bounds with
  | Within { most; _ } when must_be_over && date - began > most + r.tolerance -> finding false
  | Within { least; _ } when must_have_run && date - began < least - r.tolerance -> finding true
  | Within _ | Some_time | Never -> None

let transition (r : t) ~date ~on t =
  let is_new (p : Timed.pending) = is_timed p && not (List.mem p.item r.told) in
  let found = List.filter_map (compare_with r ~date ~on) (List.filter is_new r.state.pending) in
  let step = Timed.taken r.options r.state ~on t in
  let begins (p : Timed.pending) =
    (p.item, if List.mem p.item step.fresh then date else List.assoc p.item r.began) in
  let is_still item =
    (not (List.mem item step.fresh)) && List.exists (fun (p : Timed.pending) -> p.item = item) step.next.pending in
  let told = List.filter is_still (List.map (fun f -> f.pending.item) found @ r.told) in
  ({ r with state = step.next; began = List.map begins step.next.pending; told }, found)
