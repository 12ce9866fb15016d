let solve ~spent { Part.cotree; groups; columns; cost; _ } : Part.outcome =
  match Cotree.simple_branches cotree with
  | None -> Undecided
  | Some branches -> (
      let branches = Array.of_list branches in
      let rows = Array.length branches and width = Array.length columns in
      let sums = Array.make (rows * width) 0 in
      let add branch row =
        for column = 0 to width - 1 do
          let place = (branch * width) + column in
          sums.(place) <- Matching.add sums.(place) cost.((row * width) + column)
        done
      in
      Array.iteri (fun branch rows -> List.iter (add branch) rows) branches;
      match Matching.solve ~spent ~rows ~columns:width sums with
      | Ok matching ->
        let column_of = Matching.in_pick_order ~rows ~columns:width sums matching in
        let vehicle = Array.make (Array.length groups) 0 in
        Array.iteri (fun branch rows -> List.iter (fun row -> vehicle.(row) <- column_of.(branch)) rows) branches;
        Found vehicle
      | Error lacking ->
        let alone = List.concat_map (fun branch -> branches.(branch)) lacking in
        if List.compare_lengths alone lacking = 0 then Impossible (Some (List.map (fun row -> groups.(row)) alone))
        else Undecided)
