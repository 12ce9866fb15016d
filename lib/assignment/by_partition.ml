open Partial_assignment

(* All ways to split rows into blocks. *)
let rec partitions = function
  | [] -> [ [] ]
  | row :: rows ->
    let rec join before = function
      | [] -> []
      | block :: after -> List.rev_append before ((row :: block) :: after) :: join (block :: before) after
    in
    List.concat_map (fun blocks -> ([ row ] :: blocks) :: join [] blocks) (partitions rows)

(* A set of rows that share a vehicle, and its cost by column. *)
type block = { members : int list; costs : int array }

(* A branch: its partitions into blocks, the fewest blocks first; how many these are; and costs by column that bound
   those of the branch from below if its first row has the column. *)
type choice = { ways : block list list; fewest : int; relaxed : int array }

let choice_of search rows =
  let cost row column = search.part.cost.((row * search.width) + column) in
  let sum members column = List.fold_left (fun sum row -> Costs.add sum (cost row column)) 0 members in
  let block members =
    let members = List.sort Int.compare members in
    { members; costs = Array.init search.width (sum members) }
  in
  let is_possible { costs; _ } = Array.exists (fun c -> c < Matching.forbidden) costs in
  let by_count a b = List.compare_lengths a b in
  let by_first a b = Int.compare (List.hd a.members) (List.hd b.members) in
  let ways =
    partitions rows
    |> List.map (List.map block)
    |> List.filter (List.for_all is_possible)
    |> List.map (List.sort by_first) |> List.stable_sort by_count
  in
  let least row = Array.fold_left min Matching.forbidden (Array.init search.width (cost row)) in
  let others = List.fold_left (fun sum row -> sum + least row) 0 (List.tl rows) in
  let relaxed =
    Array.init search.width (fun column ->
        let c = cost (List.hd rows) column in
        if c >= Matching.forbidden then Matching.forbidden else c + others)
  in
  { ways; fewest = List.length (List.hd ways); relaxed }

let largest_branch = 5 (* which has 52 partitions *)

let improve search allocation =
  match Cotree.simple_branches search.part.cotree with
  | None -> (allocation, false)
  | Some branches when List.exists (fun rows -> List.compare_length_with rows largest_branch > 0) branches ->
    (allocation, false)
  | Some branches ->
    let choices = Array.of_list (List.map (choice_of search) branches) in
    let count = Array.length choices in
    let limit = count_of allocation in
    let later = Array.make (count + 1) 0 (* the fewest blocks of this branch and all later ones *) in
    for branch = count - 1 downto 0 do
      later.(branch) <- later.(branch + 1) + choices.(branch).fewest
    done;
    let best = ref allocation and least = ref (cost_of search search.part.cost allocation) in
    let rec decide branch blocks used =
      check search;
      let slack = limit - used - later.(branch) in
      if slack >= 0 then begin
        let undecided index =
          let choice = choices.(branch + index) in
          match choice.ways with
          | [ { costs; _ } ] :: _ when slack = 0 -> costs
          | _ -> choice.relaxed
        in
        let decided = List.rev_map (fun block -> block.costs) blocks in
        let matrix = Array.concat (decided @ List.init (count - branch) undecided) in
        let rows = used + count - branch in
        search.spent := !(search.spent) + (rows * search.width);
        let costs = Costs.of_array ~rows ~columns:search.width matrix in
        match Matching.solve ~spent:search.spent costs with
        | Error _ -> ()
        | Ok matching ->
          let sum = ref 0 in
          Array.iteri (fun row column -> sum := !sum + matrix.((row * search.width) + column)) matching.column_of;
          if !sum <= !least then
            if branch < count then
              List.iter
                (fun way -> decide (branch + 1) (List.rev_append way blocks) (used + List.length way))
                choices.(branch).ways
            else begin
              let column_of = Matching.in_pick_order costs matching in
              let found = Array.make search.rows 0 in
              List.iteri
                (fun index block -> List.iter (fun row -> found.(row) <- column_of.(index)) block.members)
                (List.rev blocks);
              if !sum < !least || compare found !best < 0 then begin
                least := !sum;
                best := found
              end
            end
      end
    in
    (match decide 0 [] 0 with () -> (!best, true) | exception Exhausted -> (!best, false))
