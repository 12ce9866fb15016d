open Partial_assignment

let sharing_weights search =
  let served column =
    let count = ref 0 in
    for row = 0 to search.rows - 1 do
      if search.part.cost.((row * search.width) + column) < Matching.forbidden then incr count
    done;
    !count
  in
  let served = Array.init search.width served in
  let order = Array.init search.width Fun.id in
  Array.stable_sort (fun a b -> Int.compare served.(b) served.(a)) order;
  let rank = Array.make search.width 0 in
  Array.iteri (fun place column -> rank.(column) <- place) order;
  Array.init (search.rows * search.width) (fun place -> rank.(place mod search.width))

let greedy search weights =
  let weight row column =
    if not (is_available search row column) then Matching.forbidden
    else if search.uses.(column) > 0 then 0
    else search.width + weights.((row * search.width) + column)
  in
  let serve clique =
    match Bound.match_clique search clique weight with
    | Error _ -> false
    | Ok columns ->
      Array.iteri (fun place column -> assign search clique.(place) column) columns;
      true
  in
  let is_served = Array.for_all serve search.cliques in
  let allocation = Array.copy search.assigned in
  release search;
  if is_served then Some allocation else None

(* Cliques are served again with the vehicles in use, then vehicles change places with others, until nothing gets
   better. *)
let polish search allocation =
  let cost = search.part.cost in
  let cost_at row column = cost.((row * search.width) + column) in
  let in_use = Array.make search.width false in
  let serve_anew clique =
    Array.iter (fun row -> unassign search row) clique;
    let weight row column =
      if in_use.(column) && search.blocked.((row * search.width) + column) = 0 then cost_at row column
      else Matching.forbidden
    in
    match Bound.match_clique search clique weight with
    | Ok columns -> Array.iteri (fun place column -> assign search clique.(place) column) columns
    | Error _ -> assert false (* the old assignment is one way *)
  in
  let replace column =
    let rows = List.filter (fun row -> search.assigned.(row) = column) (List.init search.rows Fun.id) in
    let total column = List.fold_left (fun sum row -> Costs.add sum (cost_at row column)) 0 rows in
    let best = ref column and least = ref (total column) in
    for other = 0 to search.width - 1 do
      if search.uses.(other) = 0 && total other < !least then begin
        best := other;
        least := total other
      end
    done;
    if !best <> column then begin
      List.iter (unassign search) rows;
      List.iter (fun row -> assign search row !best) rows
    end
  in
  let rec improve allocation rounds =
    Array.fill in_use 0 search.width false;
    Array.iter (fun column -> in_use.(column) <- true) search.assigned;
    Array.iter serve_anew search.cliques;
    for column = 0 to search.width - 1 do
      if search.uses.(column) > 0 then replace column
    done;
    search.spent := !(search.spent) + (search.rows * search.width);
    let better = Array.copy search.assigned in
    if rounds > 0 && !(search.spent) < search.ceiling && cost_of search cost better < cost_of search cost allocation
    then improve better (rounds - 1)
    else better
  in
  Array.iteri (assign search) allocation;
  let better = improve allocation 20 in
  release search;
  better
