open Dolphin_semantics

type t = (Core.vehicle * int) list

let unknown = max_int
let ( ++ ) a b = if a = unknown || b = unknown then unknown else a + b
let times n a = if n = 0 then 0 else if a = unknown then unknown else n * a
let label v (p : Core.platform_task) : Canonical_state.label = { name = p.name; vehicle = v; site = p.task_site }

let is_mapped execution label =
  match execution with Some e -> List.compare_length_with (Canonical_state.orbit e label) 1 > 0 | None -> false

(* {1 Of whole executions} *)

(* The time that the tasks of [v] in [r] take, where one takes [cost]. *)
let rec longest cost v (r : Residual.t) =
  let sum rs = List.fold_left (fun n r -> n ++ longest cost v r) 0 rs in
  let bodies = List.map (fun (b : Residual.branch) -> b.body) in
  match r with
  | Ready (p, w) | Running (p, w) -> if w = v then cost p else 0
  | Sequence (a, rest) -> sum (a :: rest)
  | Parallel bs -> sum (Branches.to_list bs)
  | All_of (a, bs) -> sum (Option.to_list a @ bodies bs)
  | One_of bs -> List.fold_left (fun n r -> max n (longest cost v r)) 0 (bodies bs)
  | Until (_, _, a) | During { body = a; _ } | Watch (a, _) | Hold (_, a) | Recruited (_, a) | Fresh (_, a)
  | Ensure (_, a) ->
    longest cost v a
  | Repeat { round; again = { left = Some n; each; _ } } ->
    sum (Option.to_list round) ++ times n (longest cost v each)
  | Action _ | Condition _ | Idle _ | Confirm _ -> 0
  | Repeat { again = { left = None; _ }; _ } | Made _ | Unallocated _ | Recruit _ -> unknown

let at_start (o : Clocked.options) execution (c : Configuration.t) =
  match c.control with
  | Executing (_, r) ->
    let of_vehicle v =
      let cost (p : Core.platform_task) =
        if is_mapped execution (label v p) then
          match o.durations.task v None p with Within { most; _ } -> most | Some_time | Never -> unknown
        else 0
      in
      (v, longest cost v r)
    in
    List.map of_vehicle (Residual.named r)
  | Script _ | Waiting _ | Ended _ -> []

(* {1 Of steps} *)

let ended (before : Zone_node.t) zone (step : Clocked.step) (p : Clocked.pending) =
  let is_awaited item = List.exists (fun (p : Clocked.pending) -> p.item = item) step.next.pending in
  match p.item, p.task with
  | Task v, Some task
    when ((not (is_awaited p.item)) || List.mem p.item step.fresh)
      && not (Inert.is_awaited before.inert p.item || is_mapped before.execution (label v task)) ->
    let since = Option.bind (List.assoc_opt p.item before.clocks) (fun clock -> Zone.most clock zone) in
    let since = Option.value since ~default:unknown in
    (match p.progress, p.bounds with
     | Ordered, _ -> None
     | Over, Within { most; _ } -> Some (v, min since most)
     | Over, (Some_time | Never) | Under_way, _ -> Some (v, since))
  | ( Task _ | Timer _ | Question _ | Recruit _ | Answer | Reply | Posting _ | Links | Silence _ | Course _ | Date _ ),
    _ -> None

let begun execution (p : Inert.part) =
  match Happening.task_of_part p with
  | Some task when not (is_mapped execution task) -> Some (task.vehicle, p.most)
  | Some _ | None -> None

let of_step o (before : Zone_node.t) zone ({ step; begun = begins; _ } : Zone_node.arrow) execution =
  let whole =
    match before.execution, execution with
    | None, Some _ -> at_start o execution step.next.configuration
    | _, _ -> []
  in
  let over = List.filter_map (ended before zone step) before.state.pending in
  let counted = whole @ over @
                List.filter_map (begun execution) (List.concat_map (fun (i : Inert.item) -> i.parts) begins)
  in
  let add found (v, ms) = (v, ms ++ Option.value (List.assoc_opt v found) ~default:0) :: List.remove_assoc v found in
  List.filter (fun (_, ms) -> ms > 0) (List.fold_left add [] counted)
