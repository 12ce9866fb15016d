type t = {
  part : Part.t;
  rows : int;
  width : int;
  exclusions : int array array;
  cliques : int array array;
  below : int list array;
  free : bool array;
  alike : int array;
  spent : int ref;
  assigned : int array;
  uses : int array;
  blocked : int array;
  mutable used : int;
  mutable limit : int;
  mutable ceiling : int;
}

exception Exhausted

let make ~spent (part : Part.t) =
  let rows = Array.length part.groups and width = Array.length part.columns in
  let choice =
    Array.init rows (fun row ->
        let count = ref 0 in
        for column = 0 to width - 1 do
          if part.cost.((row * width) + column) < Matching.forbidden then incr count
        done;
        !count)
  in
  let seen = Hashtbl.create 16 in
  let alike column =
    let costs = Array.init rows (fun row -> part.cost.((row * width) + column)) in
    let key = Array.fold_left (fun hash c -> (hash * 1_000_003) lxor c) 0 costs in
    match List.find_opt (fun (_, costs') -> costs = costs') (Hashtbl.find_all seen key) with
    | Some (other, _) -> other
    | None ->
      Hashtbl.add seen key (column, costs);
      column
  in
  {
    part;
    rows;
    width;
    exclusions = Cotree.exclusions part.cotree;
    cliques = Cotree.cliques part.cotree ~choice;
    below = Cotree.leaves part.cotree;
    free = Cotree.is_free part.cotree;
    alike = Array.init width alike;
    spent;
    assigned = Array.make rows (-1);
    uses = Array.make width 0;
    blocked = Array.make (rows * width) 0;
    used = 0;
    limit = max_int;
    ceiling = max_int;
  }

let check search = if !(search.spent) > search.ceiling then raise_notrace Exhausted

let is_available search row column =
  let place = (row * search.width) + column in
  if search.assigned.(row) >= 0 then search.assigned.(row) = column
  else
    search.part.cost.(place) < Matching.forbidden
    && search.blocked.(place) = 0
    && (search.uses.(column) > 0 || search.used < search.limit)

let add_blocks search row column change =
  Array.iter
    (fun other ->
       let place = (other * search.width) + column in
       search.blocked.(place) <- search.blocked.(place) + change)
    search.exclusions.(row)

let assign search row column =
  search.assigned.(row) <- column;
  if search.uses.(column) = 0 then search.used <- search.used + 1;
  search.uses.(column) <- search.uses.(column) + 1;
  add_blocks search row column 1

let unassign search row =
  let column = search.assigned.(row) in
  search.assigned.(row) <- -1;
  search.uses.(column) <- search.uses.(column) - 1;
  if search.uses.(column) = 0 then search.used <- search.used - 1;
  add_blocks search row column (-1)

let release search = Array.iteri (fun row column -> if column >= 0 then unassign search row) search.assigned

let domain_sizes search =
  Array.init search.rows (fun row ->
      let count = ref 0 in
      for column = 0 to search.width - 1 do
        if is_available search row column then incr count
      done;
      !count)

let cost_of search weights allocation =
  let sum = ref 0 in
  Array.iteri (fun row column -> sum := !sum + weights.((row * search.width) + column)) allocation;
  !sum

let count_of allocation = List.length (List.sort_uniq Int.compare (Array.to_list allocation))

let is_feasible search allocation =
  let fits row column = Array.for_all (fun other -> allocation.(other) <> column) search.exclusions.(row) in
  let rec check row = row = search.rows || (fits row allocation.(row) && check (row + 1)) in
  check 0
