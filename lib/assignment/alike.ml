(* The [count] cheapest vehicles, ascending. *)
let cheapest count (candidates : Part.candidates) =
  let cheap =
    match candidates.cost with
    | None -> candidates.vehicles
    | Some cost ->
      let with_cost = Array.map (fun vehicle -> (vehicle, cost vehicle)) candidates.vehicles in
      let by_cost (vehicle, c) (vehicle', c') =
        match Int.compare c c' with 0 -> Int.compare vehicle vehicle' | order -> order
      in
      Array.sort by_cost with_cost;
      Array.map fst with_cost
  in
  let vehicles = Array.sub cheap 0 count in
  Array.sort Int.compare vehicles;
  vehicles

let have_one_length = function
  | [] -> true
  | first :: others -> List.for_all (fun branch -> List.compare_lengths first branch = 0) others

let solve ~restricted (candidates : Part.candidates array) leaves =
  let first = candidates.(leaves.(0)) in
  let is_first leaf = Part.equal_candidates candidates.(leaf) first in
  let branches = if Array.for_all is_first leaves then Cotree.simple_branches (restricted leaves) else None in
  match branches with
  | Some branches
    when List.compare_length_with branches (Array.length first.vehicles) <= 0
      && (have_one_length branches || Part.cost_nothing first) ->
    let vehicles = cheapest (List.length branches) first in
    let result = Array.make (Array.length leaves) 0 in
    List.iteri (fun branch rows -> List.iter (fun row -> result.(row) <- vehicles.(branch)) rows) branches;
    Some result
  | Some _ | None -> None
