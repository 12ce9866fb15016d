let by_cost (vehicle, cost) (vehicle', cost') =
  match Int.compare cost cost' with 0 -> Int.compare vehicle vehicle' | order -> order

(* The [count] cheapest vehicles, ascending. *)
let cheapest count (candidates : Part.candidates) =
  let sorted = Array.copy candidates in
  Array.sort by_cost sorted;
  let vehicles = Array.map fst (Array.sub sorted 0 count) in
  Array.sort Int.compare vehicles;
  vehicles

let have_one_length = function
  | [] -> true
  | first :: others -> List.for_all (fun branch -> List.compare_lengths first branch = 0) others

let solve ~restricted (candidates : Part.candidates array) leaves =
  let first = candidates.(leaves.(0)) in
  let is_first leaf = candidates.(leaf) == first || candidates.(leaf) = first in
  let cost_nothing = Array.for_all (fun (_, cost) -> cost = 0) first in
  let branches = if Array.for_all is_first leaves then Cotree.simple_branches (restricted leaves) else None in
  match branches with
  | Some branches
    when List.compare_length_with branches (Array.length first) <= 0 && (cost_nothing || have_one_length branches) ->
    let vehicles = cheapest (List.length branches) first in
    let result = Array.make (Array.length leaves) 0 in
    List.iteri (fun branch rows -> List.iter (fun row -> result.(row) <- vehicles.(branch)) rows) branches;
    Some result
  | Some _ | None -> None
