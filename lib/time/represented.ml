(* A state, and its representative; its awaited events, in corresponding order. *)
type here = {
  state : Clocked.state;
  known_items : Clocked.item list;  (* of the representative *)
  items : Clocked.item list;
}

(* The place of an item among [items], from 1; -1 if it has just begun. *)
let color items (step : Clocked.step) item =
  let rec find i = function [] -> 0 | x :: rest -> if x = item then i else find (i + 1) rest in
  if List.mem item step.fresh then -1 else find 1 items

let same_due here (known : Clocked.step) (step : Clocked.step) =
  match known.due, step.due with
  | Some (item, bounds), Some (item', bounds') ->
    Bounds.compare bounds bounds' = 0 && color here.known_items known item = color here.items step item'
  | None, None -> true
  | Some _, None | None, Some _ -> false

let both_ended (a : Clocked.state) (b : Clocked.state) =
  match a.configuration.control, b.configuration.control with
  | Ended (Completed | Interrupted), Ended (Completed | Interrupted)
  | Ended (Halted _), Ended (Halted _)
  | Ended (Failed _), Ended (Failed _) ->
    true
  | (Script _ | Waiting _ | Executing _ | Ended _), _ -> false

(* The form of the successor of [known], if that belongs to an execution. *)
let known_form successors here execution (known : Clocked.step) =
  let form likeness e =
    let spelled = Canonical_state.spell likeness e (Successors.inert successors known.next) known.next in
    (e, Canonical_state.form ~color:(color here.known_items known) ~colored:true spelled)
  in
  Option.bind (Successors.likeness successors) (fun likeness -> Option.map (form likeness) execution)

(* The awaited events after [step], in the order of [items] after [known], if both lead to states that are alike. *)
let correspondence here (known : Clocked.step) form items { Successors.step; spelled; inert = _ } =
  if not (same_due here known step && known.transition.rules = step.transition.rules) then None
  else
    match Lazy.force form with
    | Some (e, (of_known : Canonical_state.form)) ->
      let own = Canonical_state.form ~color:(color here.items step) ~colored:true (spelled e) in
      if of_known.number = own.number then
        let pairs = List.combine of_known.items own.items in
        Some (List.filter_map (fun item -> List.assoc_opt item pairs) items)
      else None
    | None -> if Clocked.equal known.next step.next || both_ended known.next step.next then Some items else None

let take system here (a : Timed_system.arrival) : (Timed_system.move * here) option =
  let successors = Timed_system.successors system in
  let into state items = { state; known_items = a.items; items } in
  match a.move with
  | Step { step = known; last; items; begun = known_begun } ->
    let form = lazy (known_form successors here a.execution known) in
    let find successor =
      Option.map (fun items -> (successor, items)) (correspondence here known form items successor) in
    let arrive ({ Successors.step; inert; spelled = _ }, items) : Timed_system.move * here =
      let before = Successors.inert successors here.state in
      let has_begun (i : Inert.item) = not (Inert.is_awaited before i.awaited) in
      let begun = List.filter has_begun (Lazy.force inert) in
      let is_like (i : Inert.item) =
        let is_it (j : Inert.item) = last = Some j.awaited && i.least = j.least && i.most = j.most in
        List.exists is_it known_begun
      in
      let last = Option.map (fun (i : Inert.item) -> i.awaited) (List.find_opt is_like begun) in
      (Step { step; begun; last; items }, into step.next items)
    in
    Option.map arrive (List.find_map find (Successors.all successors here.state))
  | Rest { later; steps = _ } -> (
      let steps = Zone_node.ends_of_rest (Timed_system.places system) here.state in
      match List.rev steps with
      | last :: _ when Clocked.equal last.next a.into || both_ended last.next a.into ->
        Some (Rest { steps; later }, into last.next a.items)
      | _ -> None)

let moves system arrivals =
  let start = Timed_system.start system in
  let items = List.map (fun (p : Clocked.pending) -> p.item) start.pending in
  let rec go found here = function
    | [] -> Some (List.rev found)
    | arrival :: rest -> (
        match take system here arrival with
        | Some (move, here) -> go (move :: found) here rest
        | None -> None)
  in
  go [] { state = start; known_items = items; items } arrivals
