(* A state, and what stands for it; what is awaited there, in an order in which it corresponds. *)
type here = {
  state : Timed.state;
  known_items : Timed.item list;  (* of the representative *)
  items : Timed.item list;
}

(* The place of an item among [items], from 1; -1 if it has just begun. *)
let color items (step : Timed.step) item =
  let rec find i = function [] -> 0 | x :: rest -> if x = item then i else find (i + 1) rest in
  if List.mem item step.fresh then -1 else find 1 items

let same_due here (known : Timed.step) (step : Timed.step) =
  match known.due, step.due with
  | Some (item, bounds), Some (item', bounds') ->
    Bounds.compare bounds bounds' = 0 && color here.known_items known item = color here.items step item'
  | None, None -> true
  | Some _, None | None, Some _ -> false

let both_ended (a : Timed.state) (b : Timed.state) =
  match a.configuration.control, b.configuration.control with
  | Ended (Completed | Interrupted), Ended (Completed | Interrupted)
  | Ended (Halted _), Ended (Halted _)
  | Ended (Failed _), Ended (Failed _) ->
    true
  | (Script _ | Waiting _ | Executing _ | Ended _), _ -> false

(* What is awaited after [step], in the order of [items] after [known], if both lead to states that are alike. *)
let correspondence system here execution (known : Timed.step) items (step : Timed.step) =
  if not (same_due here known step && known.transition.rules = step.transition.rules) then None
  else
    match Timed_place.likeness (Timed_system.places system), execution with
    | Some likeness, Some e ->
      let form items (step : Timed.step) =
        let inert = Timed_place.inert (Timed_system.places system) step.next in
        let spelled = Likeness.spell likeness e inert step.next in
        Likeness.form likeness e ~color:(color items step) ~colored:true spelled
      in
      let of_known = form here.known_items known and own = form here.items step in
      if of_known.number = own.number then
        let pairs = List.combine of_known.items own.items in
        Some (List.filter_map (fun item -> List.assoc_opt item pairs) items)
      else None
    | (Some _ | None), _ ->
      if Timed.equal known.next step.next || both_ended known.next step.next then Some items else None

let take system options here (a : Timed_system.arrival) : (Timed_system.move * here) option =
  let into state items = { state; known_items = a.items; items } in
  match a.move with
  | Step { step = known; last; items; begun = known_begun } ->
    let find step =
      Option.map (fun items -> (step, items)) (correspondence system here a.execution known items step) in
    let arrive ((step : Timed.step), items) : Timed_system.move * here =
      let before = Timed_place.inert (Timed_system.places system) here.state in
      let is_new i = not (List.mem i before) in
      let begun = List.filter is_new (Timed_place.inert (Timed_system.places system) step.next) in
      let is_like (i : Inert.item) =
        let is_it (j : Inert.item) = last = Some j.awaited && i.least = j.least && i.most = j.most in
        List.exists is_it known_begun
      in
      let last = Option.map (fun (i : Inert.item) -> i.awaited) (List.find_opt is_like begun) in
      (Step { step; begun; last; items }, into step.next items)
    in
    Option.map arrive (List.find_map find (Timed.all_steps options here.state))
  | Rest { later; steps = _ } -> (
      let steps = Timed_place.ends_of_rest (Timed_system.places system) here.state in
      match List.rev steps with
      | last :: _ when Timed.equal last.next a.into || both_ended last.next a.into ->
        Some (Rest { steps; later }, into last.next a.items)
      | _ -> None)

let moves system options arrivals =
  let start = Timed_system.start system in
  let items = List.map (fun (p : Timed.pending) -> p.item) start.pending in
  let rec go found here = function
    | [] -> Some (List.rev found)
    | arrival :: rest -> (
        match take system options here arrival with
        | Some (move, here) -> go (move :: found) here rest
        | None -> None)
  in
  go [] { state = start; known_items = items; items } arrivals
