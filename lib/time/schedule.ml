type link = {
  pending : Clocked.pending;
  at : Dolphin_semantics.Core.site option;
  from : int;
  until : int;
  lasts : int;
}

type t = { dates : int array; chain : link list }

let find item (s : Clocked.state) = List.find_opt (fun (p : Clocked.pending) -> p.item = item) s.pending

(* The bounds of step [k], taken from [s], where [begun] maps each item to the step with which it began. *)
let bounds_of steps_of k (s : Clocked.state) begun (step : Clocked.step) =
  let from item = List.assoc item begun and due_to item = find item s in
  let at_most (item, most) = Dates.at_most ?due_to:(due_to item) k ~after:(from item) most in
  let order = Dates.at_least k ~after:(k - 1) 0 in
  let is_urgent (step : Clocked.step) = step.urgent in
  if is_urgent step || List.exists is_urgent (steps_of s) then [ order; Dates.at_most k ~after:(k - 1) 0 ]
  else
    let due =
      match step.due with
      | Some (item, Within { least; most }) ->
        [ Dates.at_least ?due_to:(due_to item) k ~after:(from item) least; at_most (item, most) ]
      | Some (_, (Some_time | Never)) | None -> []
    in
    (order :: due) @ List.map at_most (Clocked.holds_up (steps_of s))

type walk = { state : Clocked.state; begun : (Clocked.item * int) list }

let set_out (start : Clocked.state) =
  { state = start; begun = List.map (fun (p : Clocked.pending) -> (p.item, 0)) start.pending }

let walk w k (step : Clocked.step) =
  let still (p : Clocked.pending) =
    (p.item, if List.mem p.item step.fresh then k else List.assoc p.item w.begun) in
  { state = step.next; begun = List.map still step.next.pending }

let bounds steps_of w k step = bounds_of steps_of k w.state w.begun step

let all successors start steps =
  let add (k, w, found) step = (k + 1, walk w k step, bounds (Successors.steps successors) w k step @ found) in
  let _, _, found = List.fold_left add (1, set_out start, []) steps in
  List.rev found

(* [state k] is the state after step [k]. *)
let chain ~state last n =
  let rec back links k =
    match last.(k) with
    | None -> links
    | Some { Dates.sooner; by; due_to = Some (pending : Clocked.pending); later } when by > 0 ->
      let at = Clocked.site (state sooner) pending.item in
      back ({ pending; at; from = sooner; until = later; lasts = by } :: links) sooner
    | Some { sooner; _ } -> back links sooner
  in
  back [] n

let all_known dates = if Array.for_all Option.is_some dates then Some (Array.map Option.get dates) else None
let of_steps n dates = Array.sub dates 1 n

let make (goal : Timed_system.goal) successors start steps =
  let n = List.length steps in
  let bounds = all successors start steps in
  let states = Array.of_list (start :: List.map (fun (step : Clocked.step) -> step.next) steps) in
  match goal with
  | Latest ->
    let dates, last = Dates.latest n bounds in
    let make dates = { dates = of_steps n dates; chain = chain ~state:(Array.get states) last n } in
    Option.map make (all_known dates)
  | Earliest -> Option.map (fun dates -> { dates = of_steps n dates; chain = [] }) (all_known (Dates.earliest n bounds))

let stretched successors start steps spans =
  let n = List.length steps in
  Option.map (of_steps n) (all_known (Dates.stretched n (all successors start steps) spans))
