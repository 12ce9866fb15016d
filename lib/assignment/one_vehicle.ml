(* The costs of whole branches are written row by row, so that those of their leaves are nowhere held. *)
let costs_of candidates columns branches =
  let width = Array.length columns and column_of = Part.by_vehicle columns in
  let own = Array.make width Costs.forbidden in
  let add sums leaf =
    Array.fill own 0 width Costs.forbidden;
    Part.visit (fun vehicle cost -> own.(column_of.(vehicle)) <- cost) candidates.(leaf);
    for column = 0 to width - 1 do
      sums.(column) <- Costs.add sums.(column) own.(column)
    done
  in
  let fill branch sums =
    Array.fill sums 0 width 0;
    List.iter (add sums) branches.(branch)
  in
  Costs.make ~rows:(Array.length branches) ~columns:width fill

let solve ~restricted ~spent (candidates : Part.candidates array) leaves =
  match Cotree.simple_branches (restricted leaves) with
  | None -> Ok None
  | Some branches -> (
      let branches = Array.of_list (List.map (List.map (Array.get leaves)) branches) in
      let columns = Part.vehicles_of candidates leaves in
      let costs = costs_of candidates columns branches in
      match Matching.solve ~spent costs with
      | Ok matching ->
        let column_of = Matching.in_pick_order costs matching in
        let vehicle branch = columns.(column_of.(branch)) in
        let of_branch branch leaves = List.map (fun leaf -> (leaf, vehicle branch)) leaves in
        Ok (Some (List.concat (Array.to_list (Array.mapi of_branch branches))))
      | Error lacking ->
        let lacking = List.map (Array.get branches) lacking in
        let is_one_with leaf leaf' = Part.equal_candidates candidates.(leaf) candidates.(leaf') in
        let are_one leaves = List.for_all (is_one_with (List.hd leaves)) leaves in
        if List.for_all are_one lacking then Error (List.map List.hd lacking) else Ok None)
