open Partial_assignment

(* [explore search weights ~bound ~is_enough matched] goes through the allocations that complete [assigned] with at
   most [limit] vehicles, and finds the one of least weight, if it is below [bound]; or any of these, if that
   [is_enough]. The second result is whether it came to its end before the steps came to [ceiling]. [matched] is as for
   {!Bound.relax}. *)
let explore search weights ~bound ~is_enough matched =
  let bound = ref bound and best = ref None in
  let is_over () = is_enough && Option.is_some !best in
  let values row preferred =
    let options = List.filter (is_available search row) (List.init search.width Fun.id) in
    let order a b =
      let rank column =
        ( (if column = preferred then 0 else 1),
          (if is_enough && search.uses.(column) > 0 then 0 else 1),
          weights.((row * search.width) + column),
          column )
      in
      compare (rank a) (rank b)
    in
    List.sort order options
  in
  let rec visit matched =
    check search;
    match Bound.relax search weights matched with
    | Error _ -> ()
    | Ok () ->
      let weight = cost_of search weights matched in
      if weight < !bound then begin
        let sizes = domain_sizes search in
        if Bound.least_vehicles search sizes <= search.limit then
          if count_of matched <= search.limit && is_feasible search matched then begin
            bound := weight;
            best := Some (Array.copy matched)
          end
          else branch matched sizes
      end
  and branch matched sizes =
    let chosen = ref (-1) in
    for row = search.rows - 1 downto 0 do
      if search.assigned.(row) < 0 && (!chosen < 0 || sizes.(row) <= sizes.(!chosen)) then chosen := row
    done;
    let row = !chosen in
    let tried = Hashtbl.create 8 in
    let attempt column =
      if (not (is_over ())) && is_available search row column then begin
        let is_new = search.uses.(column) = 0 in
        (* Unused vehicles with the same costs lead to the same, renamed. *)
        if not (is_new && Hashtbl.mem tried search.alike.(column)) then begin
          if is_new then Hashtbl.replace tried search.alike.(column) ();
          assign search row column;
          match visit (Array.copy matched) with
          | () -> unassign search row
          | exception Exhausted ->
            unassign search row;
            raise_notrace Exhausted
        end
      end
    in
    List.iter attempt (values row matched.(row))
  in
  match visit (Array.copy matched) with () -> (!best, true) | exception Exhausted -> (!best, false)

(* {1 The phases: any allocation, the fewest vehicles, the least cost, pick order} *)

let rec fewest_vehicles search weights ~least allocation =
  let count = count_of allocation in
  if count <= least then (allocation, true)
  else begin
    search.limit <- count - 1;
    match explore search weights ~bound:max_int ~is_enough:true (Bound.nothing_matched search) with
    | Some fewer, _ -> fewest_vehicles search weights ~least fewer
    | None, is_complete -> (allocation, is_complete)
  end

let least_cost search allocation =
  let cost = search.part.cost in
  search.limit <- count_of allocation;
  let bound = cost_of search cost allocation in
  let better, is_complete = explore search cost ~bound ~is_enough:false (Bound.nothing_matched search) in
  (Option.value better ~default:allocation, is_complete)

(* Row by row, the lowest column with which some allocation has as few vehicles and costs as little. *)
let pick_order search allocation =
  let cost = search.part.cost in
  search.limit <- count_of allocation;
  let bound = cost_of search cost allocation + 1 in
  let best = ref allocation and is_complete = ref true in
  let matched = Bound.nothing_matched search in
  let exchange a b = Array.map (fun column -> if column = a then b else if column = b then a else column) !best in
  let settle row =
    let tried = Hashtbl.create 8 in
    (* Whether [column], just assigned to [row], can stay. *)
    let works column =
      let before = !best.(row) in
      let is_new = search.uses.(column) = 1 in
      if is_new && search.uses.(before) = 0 && search.alike.(column) = search.alike.(before) then begin
        best := exchange column before;
        true
      end
      else if is_new && Hashtbl.mem tried search.alike.(column) then false
      else begin
        if is_new then Hashtbl.replace tried search.alike.(column) ();
        match explore search cost ~bound ~is_enough:true matched with
        | Some lower, _ ->
          best := lower;
          true
        | None, completed ->
          if not completed then is_complete := false;
          false
      end
    in
    let rec lower column =
      if column = !best.(row) || not !is_complete then assign search row !best.(row)
      else if not (is_available search row column) then lower (column + 1)
      else begin
        assign search row column;
        if not (works column) then begin
          unassign search row;
          lower (column + 1)
        end
      end
    in
    lower 0;
    if !is_complete then ignore (Bound.relax search cost matched)
  in
  for row = 0 to search.rows - 1 do
    settle row
  done;
  release search;
  (!best, !is_complete)

(* Any allocation, for which no more than [ceiling] steps are made. *)
let any_allocation search weights ~ceiling : Part.outcome =
  match Bound.relax search weights (Bound.nothing_matched search) with
  | Error rows -> Impossible (Some (List.map (fun row -> search.part.groups.(row)) rows))
  | Ok () -> (
      match Heuristic.greedy search weights with
      | Some allocation -> Found allocation
      | None -> (
          search.ceiling <- ceiling;
          match explore search weights ~bound:max_int ~is_enough:true (Bound.nothing_matched search) with
          | Some allocation, _ -> Found allocation
          | None, true -> Impossible None
          | None, false -> Undecided))

(* Some of the leaves of [part], which has no allocation, that have none either: leaves are left out one by one, the
   last first, as long as the rest is found to have none within [budget] steps. *)
let smaller_conflict ~restricted ~spent ~budget candidates (part : Part.t) =
  let ceiling = !spent + budget in
  (* [kept] ascends, [leaves] descends, and all of these are below those. *)
  let rec leave_out kept leaves =
    match leaves with
    | [] -> kept
    | leaf :: leaves ->
      let rest = List.rev_append leaves kept in
      if !spent >= ceiling then List.rev_append leaves (leaf :: kept)
      else
        let search = Partial_assignment.make ~spent (Part.make ~restricted candidates (Array.of_list rest)) in
        match any_allocation search (Heuristic.sharing_weights search) ~ceiling with
        | Impossible (Some fewer) -> fewer
        | Impossible None -> leave_out kept leaves
        | Found _ | Undecided -> leave_out (leaf :: kept) leaves
  in
  leave_out [] (List.rev (Array.to_list part.groups))

let solve ~restricted ~spent ~budget candidates part =
  let search = Partial_assignment.make ~spent part in
  let weights = Heuristic.sharing_weights search in
  match any_allocation search weights ~ceiling:max_int with
  | Undecided -> assert false (* without a ceiling *)
  | Impossible (Some leaves) -> Error leaves
  | Impossible None -> Error (smaller_conflict ~restricted ~spent ~budget candidates part)
  | Found allocation ->
    let start = !spent in
    let until share = search.ceiling <- start + int_of_float (share *. float_of_int budget) in
    let least = Bound.least_vehicles search (domain_sizes search) in
    until 0.4;
    let allocation, has_fewest = fewest_vehicles search weights ~least allocation in
    let allocation = Heuristic.polish search allocation in
    until 0.6;
    let allocation, has_least = least_cost search allocation in
    until 0.7;
    let allocation, is_first = if has_least then pick_order search allocation else (allocation, false) in
    if has_fewest && has_least && is_first then Ok (allocation, true)
    else begin
      until 0.9;
      let allocation, is_best = if has_fewest then By_partition.improve search allocation else (allocation, false) in
      until 1.;
      let allocation = if is_best then allocation else fst (pick_order search allocation) in
      Ok (allocation, is_best)
    end
