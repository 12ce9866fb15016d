open Partial_assignment

let match_clique search clique weight =
  let count = Array.length clique in
  let costs =
    Array.init (count * search.width) (fun place -> weight clique.(place / search.width) (place mod search.width))
  in
  search.spent := !(search.spent) + (count * search.width);
  match Matching.solve ~spent:search.spent (Costs.of_array ~rows:count ~columns:search.width costs) with
  | Ok matching -> Ok matching.column_of
  | Error rows -> Error (List.map (fun place -> clique.(place)) rows)

let nothing_matched search = Array.make search.rows (-1)

(* The still available part of the matching of a larger problem has least cost too, hence only cliques that lost a
   pair are solved again. *)
let relax search weights matched =
  let is_intact = Array.for_all (fun row -> matched.(row) >= 0 && is_available search row matched.(row)) in
  let solve clique =
    let weight row column =
      if is_available search row column then weights.((row * search.width) + column) else Matching.forbidden
    in
    match_clique search clique weight
    |> Result.map (Array.iteri (fun place column -> matched.(clique.(place)) <- column))
  in
  let rec solve_all index =
    if index = Array.length search.cliques then Ok ()
    else if is_intact search.cliques.(index) then solve_all (index + 1)
    else match solve search.cliques.(index) with Ok () -> solve_all (index + 1) | Error _ as error -> error
  in
  solve_all 0

(* How many of these branches can be served by one vehicle each, all at once: a largest matching of them with the
   vehicles that are available to all their rows. *)
let single_services search branches =
  let branches = Array.of_list branches in
  let held_by = Array.make search.width (-1) in
  let serves column rows = List.for_all (fun row -> is_available search row column) rows in
  let usable =
    Array.map (fun rows -> List.filter (fun column -> serves column rows) (List.init search.width Fun.id)) branches
  in
  let rec place visited branch =
    List.exists
      (fun column ->
         incr search.spent;
         (not visited.(column))
         && begin
           visited.(column) <- true;
           if held_by.(column) < 0 || place visited held_by.(column) then begin
             held_by.(column) <- branch;
             true
           end
           else false
         end)
      usable.(branch)
  in
  let count = ref 0 in
  Array.iteri
    (fun branch _ ->
       if place (Array.make search.width false) branch then incr count)
    branches;
  !count

(* A number of rows without a vehicle in common, taken as they come in [rows]. *)
let pairwise_apart search rows =
  let taken = Array.make search.width false in
  let is_apart row =
    let rec check column =
      column = search.width || ((not (taken.(column) && is_available search row column)) && check (column + 1))
    in
    check 0
  in
  let take count row =
    if is_apart row then begin
      for column = 0 to search.width - 1 do
        if is_available search row column then taken.(column) <- true
      done;
      count + 1
    end
    else count
  in
  List.fold_left take 0 rows

(* [All_different] adds up its branches, and one more for each that could be served by one vehicle alone, but not at
   once with the others; [Any] takes the greatest part, or rows that have no vehicle in common. *)
let least_vehicles search sizes =
  let scarce_first rows = List.stable_sort (fun a b -> Int.compare sizes.(a) sizes.(b)) rows in
  let inner node kind children =
    match kind with
    | Cotree.A_leaf _ | Any ->
      let part = List.fold_left (fun most (need, _) -> max most need) 0 children in
      let need = max part (pairwise_apart search (scarce_first search.below.(node))) in
      (need, if need = 1 && search.free.(node) then Some search.below.(node) else None)
    | All_different ->
      let need = List.fold_left (fun sum (need, _) -> sum + need) 0 children in
      let single = List.filter_map snd children in
      let is_plain = List.for_all (function [ _ ] -> true | _ -> false) single in
      (* Rows alone have been checked by [relax]. *)
      let more = if is_plain then 0 else List.length single - single_services search single in
      (need + more, None)
  in
  (* The rows are gone through for their sizes, twice for being apart, and once for single services. *)
  search.spent := !(search.spent) + (4 * search.rows * search.width);
  let needs = Cotree.bottom_up search.part.cotree ~leaf:(fun row -> (1, Some [ row ])) ~inner in
  max search.used (fst needs.(0))
