type 'a tree = Leaf of 'a | Disjoint of 'a tree list | Shared of 'a tree list

type leaf = { candidates : (int * float) array }

type failure = No_candidate of int | Conflict of { leaves : int list; vehicles : int list }

type solution = { vehicles : int array; proven : bool }

let effort = 200_000_000

let pp_failure ppf = function
  | No_candidate leaf -> Fmt.pf ppf "leaf %d has no candidate" leaf
  | Conflict { leaves; vehicles } ->
    let numbers = Fmt.(list ~sep:(any ", ") int) in
    Fmt.pf ppf "leaves %a cannot all be served by vehicles %a" numbers leaves numbers vehicles

(* Throughout, a matrix is a flat array, row by row; the rows are leaves, groups or branches of them, the columns
   vehicles in pick order. Costs are whole millimetres. *)

(* {1 Assignment of least cost} *)

(* The cost of what is not allowed. Sums of allowed costs stay far below. *)
let forbidden = max_int / 4

module Matching = struct
  type t = {
    column_of : int array;  (* by row *)
    row_of : int array;  (* by column, -1 for none *)
    dual : int array;  (* by column: not positive, 0 for columns without row *)
  }

  (* Each row that has one takes a free column among its cheapest: so dear searches start from few rows only. *)
  let take_cheapest ~rows ~columns cost column_of row_of =
    for row = 0 to rows - 1 do
      let base = row * columns in
      let least = ref forbidden and choice = ref (-1) in
      for column = 0 to columns - 1 do
        let c = cost.(base + column) in
        if c < !least then begin
          least := c;
          choice := if row_of.(column) < 0 then column else -1
        end
        else if c = !least && !choice < 0 && c < forbidden && row_of.(column) < 0 then choice := column
      done;
      if !choice >= 0 then begin
        column_of.(row) <- !choice;
        row_of.(!choice) <- row
      end
    done

  (* [solve ~spent ~rows ~columns cost] is a matching of all rows of least cost, by shortest augmenting paths after
     Jonker and Volgenant (1987); or rows that have fewer columns, although all but any one of them can be matched.
     Adds its steps to [spent].

     One search runs Dijkstra's algorithm over the columns. [order] holds first the columns that are done, up to
     [low], then those at distance [least] that are not, up to [high], then the others. *)
  let solve ~spent ~rows ~columns cost =
    let column_of = Array.make rows (-1) and row_of = Array.make columns (-1) in
    let dual = Array.make columns 0 in
    take_cheapest ~rows ~columns cost column_of row_of;
    spent := !spent + (rows * columns);
    let distance = Array.make columns 0 and previous = Array.make columns 0 in
    let order = Array.init columns Fun.id in
    let swap a b =
      let column = order.(a) in
      order.(a) <- order.(b);
      order.(b) <- column
    in
    let search start =
      for column = 0 to columns - 1 do
        let c = cost.((start * columns) + column) in
        distance.(column) <- (if c < forbidden then c - dual.(column) else max_int);
        previous.(column) <- start
      done;
      let low = ref 0 and high = ref 0 and least = ref 0 in
      let settled = ref 0 (* the columns that were done before [least] rose *) in
      let target = ref (-1) and stuck = ref (columns = 0) in
      while !target < 0 && not !stuck do
        if !low = !high then begin
          settled := !low;
          least := max_int;
          for place = !low to columns - 1 do
            let d = distance.(order.(place)) in
            if d < !least then begin
              high := !low;
              least := d
            end;
            if d = !least && d < max_int then begin
              swap place !high;
              incr high
            end
          done;
          spent := !spent + (columns - !low);
          if !low = !high then stuck := true
          else
            for place = !low to !high - 1 do
              if !target < 0 && row_of.(order.(place)) < 0 then target := order.(place)
            done
        end;
        if !target < 0 && not !stuck then begin
          let column = order.(!low) in
          incr low;
          let row = row_of.(column) in
          let base = row * columns in
          let saved = cost.(base + column) - dual.(column) - !least in
          let place = ref !high in
          spent := !spent + (columns - !high);
          while !target < 0 && !place < columns do
            let column = order.(!place) in
            let c = cost.(base + column) in
            if c < forbidden then begin
              let d = c - dual.(column) - saved in
              if d < distance.(column) then begin
                distance.(column) <- d;
                previous.(column) <- row;
                if d = !least then
                  if row_of.(column) < 0 then target := column
                  else begin
                    swap !place !high;
                    incr high
                  end
              end
            end;
            incr place
          done
        end
      done;
      if !stuck then begin
        let scanned = List.init !low (fun place -> row_of.(order.(place))) in
        Error (List.sort Int.compare (start :: scanned))
      end
      else begin
        for place = 0 to !settled - 1 do
          let column = order.(place) in
          dual.(column) <- dual.(column) + distance.(column) - !least
        done;
        let rec augment column =
          let row = previous.(column) in
          let released = column_of.(row) in
          row_of.(column) <- row;
          column_of.(row) <- column;
          if row <> start then augment released
        in
        augment !target;
        Ok ()
      end
    in
    let rec search_all row =
      if row = rows then Ok { column_of; row_of; dual }
      else if column_of.(row) >= 0 then search_all (row + 1)
      else match search row with Ok () -> search_all (row + 1) | Error _ as error -> error
    in
    search_all 0

  (* [in_pick_order ~rows ~columns cost matching] is, by row, the lexicographically least among the matchings that
     cost as little as [matching]. These are the matchings of all rows that use tight pairs only, of reduced cost 0,
     and every column whose dual is below 0. To see them as perfect matchings, one more row, [spare], holds all
     columns that are free, and may hold any whose dual is 0. Row by row, a lower column is taken if, along tight
     pairs between later rows, its holder can in the end be given the column that the row gave up. *)
  let in_pick_order ~rows ~columns cost { column_of; row_of; dual } =
    let spare = rows in
    let column_of = Array.copy column_of in
    let holder = Array.map (fun row -> if row < 0 then spare else row) row_of in
    let is_tight row column =
      if row = spare then dual.(column) = 0
      else
        let own = column_of.(row) in
        let base = row * columns in
        let c = cost.(base + column) in
        c < forbidden && c - dual.(column) = cost.(base + own) - dual.(own)
    in
    let tight row =
      let rec list column found =
        if column < 0 then Array.of_list found
        else list (column - 1) (if is_tight row column then column :: found else found)
      in
      list (columns - 1) []
    in
    let tight = Array.init (rows + 1) tight in
    let may_hold = Array.init (rows + 1) (fun row ->
        let set = Bytes.make columns '\000' in
        Array.iter (fun column -> Bytes.set set column '\001') tight.(row);
        set)
    in
    let visited = Array.make (rows + 1) (-1) (* for the sake of which row, last *) in
    let gives_up = Array.make (rows + 1) 0 and gives_to = Array.make (rows + 1) 0 in
    let queue = Queue.create () in
    let visit row ~taker column =
      let next = holder.(column) in
      if next > row && visited.(next) <> row then begin
        visited.(next) <- row;
        gives_up.(next) <- column;
        gives_to.(next) <- taker;
        Queue.add next queue
      end
    in
    (* Who can take the column [wanted], among those that can be reached by giving up columns; breadth first. *)
    let rec last_taker row wanted =
      match Queue.take_opt queue with
      | None -> None
      | Some taker when Bytes.get may_hold.(taker) wanted = '\001' -> Some taker
      | Some taker ->
        Array.iter (visit row ~taker) tight.(taker);
        last_taker row wanted
    in
    let rec hand_over row taker column =
      holder.(column) <- taker;
      if taker <> spare then column_of.(taker) <- column;
      if taker <> row then hand_over row gives_to.(taker) gives_up.(taker)
    in
    for row = 0 to rows - 1 do
      let wanted = column_of.(row) in
      let rec lower place =
        let column = tight.(row).(place) in
        if column < wanted then begin
          Queue.clear queue;
          visit row ~taker:row column;
          match last_taker row wanted with
          | Some taker -> hand_over row taker wanted
          | None -> lower (place + 1)
        end
      in
      lower 0
    done;
    column_of
end

(* {1 The shape of the tree} *)

module Shape = struct
  type kind = A_leaf of int | All_different | Any

  (* Nodes by number, each after its parent and after its elder siblings; node 0 is the root, its parent is -1. *)
  type t = { parent : int array; kind : kind array }

  (* The nodes of a tree, and its leaves from left to right. *)
  let of_tree tree =
    let rec visit todo count parents kinds leaf_count leaves =
      match todo with
      | [] ->
        ( { parent = Array.of_list (List.rev parents); kind = Array.of_list (List.rev kinds) },
          Array.of_list (List.rev leaves) )
      | (parent, tree) :: todo -> (
          let inner kind children =
            let todo = List.rev_append (List.rev_map (fun child -> (count, child)) children) todo in
            visit todo (count + 1) (parent :: parents) (kind :: kinds) leaf_count leaves
          in
          match tree with
          | Leaf leaf ->
            visit todo (count + 1) (parent :: parents) (A_leaf leaf_count :: kinds) (leaf_count + 1) (leaf :: leaves)
          | Disjoint children -> inner All_different children
          | Shared children -> inner Any children)
    in
    visit [ (-1, tree) ] 0 [] [] 0 []

  (* [restriction shape] is a function that gives the shape of some leaves alone, renumbered from 0 in the order of
     the array of them, which is ascending. In it every inner node has two children at least, of another kind. *)
  let restriction { parent; kind } =
    let leaf_count =
      Array.fold_left (fun count kind -> match kind with A_leaf _ -> count + 1 | All_different | Any -> count) 0 kind
    in
    let node_of_leaf = Array.make leaf_count 0 in
    Array.iteri
      (fun node kind ->
         match kind with
         | A_leaf leaf -> node_of_leaf.(leaf) <- node
         | All_different | Any -> ())
      kind;
    let children = Array.make (Array.length parent) 0 (* that lead to chosen leaves *) in
    let becomes = Array.make (Array.length parent) (-1) in
    fun leaves ->
      let touched = ref [] in
      let rec climb node =
        if node >= 0 then begin
          children.(node) <- children.(node) + 1;
          if children.(node) = 1 then begin
            touched := node :: !touched;
            climb parent.(node)
          end
        end
      in
      Array.iter (fun leaf -> climb node_of_leaf.(leaf)) leaves;
      let touched = List.sort Int.compare !touched in
      let count = ref 0 and leaf_count = ref 0 and parents = ref [] and kinds = ref [] in
      let kind_of = Hashtbl.create 16 in
      let add node above kind =
        becomes.(node) <- !count;
        Hashtbl.replace kind_of !count kind;
        parents := above :: !parents;
        kinds := kind :: !kinds;
        incr count
      in
      let copy node =
        let above = if parent.(node) < 0 then -1 else becomes.(parent.(node)) in
        match kind.(node) with
        | A_leaf _ ->
          add node above (A_leaf !leaf_count);
          incr leaf_count
        | (All_different | Any) as kind ->
          if children.(node) = 1 || (above >= 0 && Hashtbl.find kind_of above = kind) then becomes.(node) <- above
          else add node above kind
      in
      List.iter copy touched;
      List.iter (fun node -> children.(node) <- 0) touched;
      { parent = Array.of_list (List.rev !parents); kind = Array.of_list (List.rev !kinds) }

  (* [bottom_up shape ~leaf ~inner] is, by node, what [leaf] gives for leaves, and [inner] for others, from what
     their children have, the eldest first. *)
  let bottom_up { parent; kind } ~leaf ~inner =
    let count = Array.length parent in
    let pending = Array.make count [] in
    let results = Array.make count None in
    for node = count - 1 downto 0 do
      let result =
        match kind.(node) with
        | A_leaf row -> leaf row
        | (All_different | Any) as kind -> inner node kind pending.(node)
      in
      results.(node) <- Some result;
      if parent.(node) >= 0 then pending.(parent.(node)) <- result :: pending.(parent.(node))
    done;
    Array.map Option.get results

  (* The leaves below each node, ascending. *)
  let leaves shape = bottom_up shape ~leaf:(fun row -> [ row ]) ~inner:(fun _ _ children -> List.concat children)

  (* Whether no node below, itself included, is [All_different]. *)
  let is_free shape =
    bottom_up shape ~leaf:(fun _ -> true) ~inner:(fun _ kind children -> kind = Any && List.for_all Fun.id children)

  (* The branches of the root, as leaves, if no branch has an [All_different] inside. *)
  let simple_branches shape =
    let leaves = leaves shape and is_free = is_free shape in
    match shape.kind.(0) with
    | A_leaf _ | Any -> if is_free.(0) then Some [ leaves.(0) ] else None
    | All_different ->
      let branches = ref [] and simple = ref true in
      Array.iteri
        (fun node parent ->
           if parent = 0 then begin
             branches := leaves.(node) :: !branches;
             if not is_free.(node) then simple := false
           end)
        shape.parent;
      if !simple then Some (List.rev !branches) else None

  (* For each leaf, ascending, those that exclude it. *)
  let exclusions shape =
    let leaves = leaves shape in
    let count = List.length leaves.(0) in
    let excluded = Array.make count [] in
    let exclude others row = excluded.(row) <- List.rev_append others excluded.(row) in
    let children = Array.make (Array.length shape.parent) [] in
    Array.iteri (fun node parent -> if parent >= 0 then children.(parent) <- node :: children.(parent)) shape.parent;
    Array.iteri
      (fun node kind ->
         match kind with
         | A_leaf _ | Any -> ()
         | All_different ->
           List.iter
             (fun child ->
                List.iter
                  (fun sibling -> if sibling <> child then List.iter (exclude leaves.(sibling)) leaves.(child))
                  children.(node))
             children.(node))
      shape.kind;
    Array.map (fun rows -> Array.of_list (List.sort Int.compare rows)) excluded

  (* The leaves in parts, in each of which every two exclude each other; the first part is as large as can be.
     Leaves that [choice] has less of come into the earlier parts. *)
  let cliques shape ~choice =
    let rec join parts others =
      match (parts, others) with
      | [], rest | rest, [] -> rest
      | (count, rows, least) :: parts, (count', rows', least') :: others ->
        (count + count', List.rev_append rows' rows, min least least') :: join parts others
    in
    let inner _ kind children =
      match kind with
      | All_different -> List.fold_left join [] children
      | A_leaf _ | Any ->
        List.stable_sort
          (fun (count, _, least) (count', _, least') ->
             match Int.compare count' count with 0 -> Int.compare least least' | order -> order)
          (List.concat children)
    in
    let parts = bottom_up shape ~leaf:(fun row -> [ (1, [ row ], choice.(row)) ]) ~inner in
    Array.of_list (List.map (fun (_, rows, _) -> Array.of_list (List.sort Int.compare rows)) parts.(0))
end

(* {1 Parts of a problem} *)

(* Candidates that no candidate links to other leaves' are a problem of their own. *)
type part = {
  shape : Shape.t;
  groups : int array;  (* by row, the first of the leaves that are one, ascending *)
  members : int list array;  (* by row, these leaves *)
  columns : int array;  (* by column, the vehicle, ascending *)
  cost : int array;  (* of the whole group *)
}

let millimetres metres =
  if not (metres >= 0.) then Fmt.invalid_arg "Assignment.solve: a cost of %g" metres
  else int_of_float (Float.round (Float.min metres 1e9 *. 1000.))

(* The candidates by vehicle, each once, and whole costs. *)
let ordered_candidates ~vehicles { candidates } =
  let candidates =
    Array.map
      (fun (vehicle, metres) ->
         if vehicle < 0 || vehicle >= vehicles then Fmt.invalid_arg "Assignment.solve: no vehicle %d" vehicle;
         (vehicle, millimetres metres))
      candidates
  in
  let order (vehicle, cost) (vehicle', cost') =
    match Int.compare vehicle vehicle' with 0 -> Int.compare cost cost' | order -> order
  in
  let rec ascends place =
    place >= Array.length candidates
    || (fst candidates.(place - 1) < fst candidates.(place) && ascends (place + 1))
  in
  if ascends 1 then candidates
  else begin
    Array.sort order candidates;
    let once kept (vehicle, cost) =
      match kept with
      | (previous, _) :: _ when previous = vehicle -> kept
      | _ -> (vehicle, cost) :: kept
    in
    Array.of_list (List.rev (Array.fold_left once [] candidates))
  end

(* The leaves by connected component, each ascending; the components by their first leaf. *)
let components ~vehicles candidates =
  let parent = Array.init vehicles Fun.id in
  let rec find vehicle =
    let above = parent.(vehicle) in
    if above = vehicle then vehicle
    else begin
      parent.(vehicle) <- parent.(above);
      find parent.(vehicle)
    end
  in
  let link candidates =
    let root = find (fst candidates.(0)) in
    Array.iter (fun (vehicle, _) -> parent.(find vehicle) <- root) candidates
  in
  Array.iter link candidates;
  let leaves = Hashtbl.create 16 and roots = ref [] in
  Array.iteri
    (fun leaf candidates ->
       let root = find (fst candidates.(0)) in
       match Hashtbl.find_opt leaves root with
       | None ->
         roots := root :: !roots;
         Hashtbl.add leaves root [ leaf ]
       | Some others -> Hashtbl.replace leaves root (leaf :: others))
    candidates;
  List.rev_map (fun root -> Array.of_list (List.rev (Hashtbl.find leaves root))) !roots

let hash_candidates candidates =
  Array.fold_left (fun hash (vehicle, cost) -> (((hash * 31) + vehicle) * 1_000_003) lxor cost) 0 candidates

(* By row of [shape], the least row that is one with it: they have the same [Any] parent and the same candidates.
   Moving one of two such leaves to the other's vehicle breaks nothing, and needs no further vehicle; so in the best
   allocation, were they apart, the move to the cheaper, or else to the lower vehicle, would be still better. *)
let twins (shape : Shape.t) candidates =
  let first = Hashtbl.create 16 in
  let twin = Array.make (Array.length candidates) 0 in
  Array.iteri
    (fun node kind ->
       match kind with
       | Shape.All_different | Any -> ()
       | A_leaf row ->
         let parent = shape.parent.(node) in
         let is_twin other = candidates.(other) = candidates.(row) in
         twin.(row) <-
           (if parent < 0 || shape.kind.(parent) <> Any then row
            else
              let key = (parent, hash_candidates candidates.(row)) in
              match List.find_opt is_twin (Hashtbl.find_all first key) with
              | Some other -> other
              | None ->
                Hashtbl.add first key row;
                row))
    shape.kind;
  twin

let part_of ~restricted candidates leaves =
  let own = Array.map (fun leaf -> candidates.(leaf)) leaves in
  let twin = twins (restricted leaves) own in
  let members = Array.make (Array.length leaves) [] in
  for row = Array.length leaves - 1 downto 0 do
    members.(twin.(row)) <- leaves.(row) :: members.(twin.(row))
  done;
  let members = Array.of_list (List.filter (fun members -> members <> []) (Array.to_list members)) in
  let groups = Array.map List.hd members in
  let each_candidate visit = Array.iter (fun leaf -> Array.iter visit candidates.(leaf)) groups in
  let highest = ref (-1) in
  each_candidate (fun (vehicle, _) -> highest := max !highest vehicle);
  let column_of = Array.make (!highest + 1) (-1) in
  each_candidate (fun (vehicle, _) -> column_of.(vehicle) <- 0);
  let columns = List.filter (fun vehicle -> column_of.(vehicle) = 0) (List.init (!highest + 1) Fun.id) in
  let columns = Array.of_list columns in
  Array.iteri (fun column vehicle -> column_of.(vehicle) <- column) columns;
  let width = Array.length columns in
  let cost = Array.make (Array.length groups * width) forbidden in
  Array.iteri
    (fun row leaf ->
       let size = List.length members.(row) in
       Array.iter
         (fun (vehicle, millimetres) ->
            cost.((row * width) + column_of.(vehicle)) <- size * millimetres)
         candidates.(leaf))
    groups;
  { shape = restricted groups; groups; members; columns; cost }

(* {1 One vehicle a branch}

   If the branches exclude each other, and one vehicle each is possible, nothing needs fewer vehicles. *)

type outcome =
  | Found of int array  (* by row *)
  | Impossible of int list option  (* leaves that cannot all be served, if any are known to be the cause *)
  | Undecided

let one_vehicle_a_branch ~spent { shape; groups; columns; cost; _ } =
  match Shape.simple_branches shape with
  | None -> Undecided
  | Some branches -> (
      let branches = Array.of_list branches in
      let rows = Array.length branches and width = Array.length columns in
      let sums = Array.make (rows * width) 0 in
      let add branch row =
        for column = 0 to width - 1 do
          let place = (branch * width) + column in
          let c = cost.((row * width) + column) in
          sums.(place) <- (if sums.(place) >= forbidden || c >= forbidden then forbidden else sums.(place) + c)
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

(* {1 Branch and bound} *)

exception Exhausted

(* A search, whose arrays change and change back. Rows get columns; a column is in use if a row has it. *)
type search = {
  part : part;
  rows : int;
  width : int;
  exclusions : int array array;  (* by row *)
  cliques : int array array;  (* a partition of the rows *)
  below : int list array;  (* by node, rows *)
  free : bool array;  (* by node *)
  alike : int array;  (* by column, the least column with the same costs *)
  spent : int ref;
  assigned : int array;  (* by row, -1 for none *)
  uses : int array;  (* by column, by how many rows *)
  blocked : int array;  (* by row and column, how many assigned rows forbid the pair *)
  mutable used : int;  (* columns in use *)
  mutable limit : int;  (* on columns in use *)
  mutable ceiling : int;  (* on steps *)
}

let search_of ~spent part =
  let rows = Array.length part.groups and width = Array.length part.columns in
  let choice =
    Array.init rows (fun row ->
        let count = ref 0 in
        for column = 0 to width - 1 do
          if part.cost.((row * width) + column) < forbidden then incr count
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
    exclusions = Shape.exclusions part.shape;
    cliques = Shape.cliques part.shape ~choice;
    below = Shape.leaves part.shape;
    free = Shape.is_free part.shape;
    alike = Array.init width alike;
    spent;
    assigned = Array.make rows (-1);
    uses = Array.make width 0;
    blocked = Array.make (rows * width) 0;
    used = 0;
    limit = max_int;
    ceiling = max_int;
  }

let is_available search row column =
  let place = (row * search.width) + column in
  if search.assigned.(row) >= 0 then search.assigned.(row) = column
  else
    search.part.cost.(place) < forbidden
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

let domain_sizes search =
  Array.init search.rows (fun row ->
      let count = ref 0 in
      for column = 0 to search.width - 1 do
        if is_available search row column then incr count
      done;
      !count)

(* [cost_of weights allocation] is their sum. *)
let cost_of search weights allocation =
  let sum = ref 0 in
  Array.iteri (fun row column -> sum := !sum + weights.((row * search.width) + column)) allocation;
  !sum

let count_of allocation = List.length (List.sort_uniq Int.compare (Array.to_list allocation))

let is_feasible search allocation =
  let fits row column = Array.for_all (fun other -> allocation.(other) <> column) search.exclusions.(row) in
  let rec check row = row = search.rows || (fits row allocation.(row) && check (row + 1)) in
  check 0

(* {2 Bounds} *)

(* The columns of the rows of [clique], all different, of least [weight], which may be [forbidden]; or rows of it
   that have too few columns. *)
let match_clique search clique weight =
  let count = Array.length clique in
  let costs =
    Array.init (count * search.width) (fun place -> weight clique.(place / search.width) (place mod search.width))
  in
  search.spent := !(search.spent) + (count * search.width);
  match Matching.solve ~spent:search.spent ~rows:count ~columns:search.width costs with
  | Ok matching -> Ok matching.column_of
  | Error rows -> Error (List.map (fun place -> clique.(place)) rows)

(* The least cost at which the cliques can be served, each for itself: a relaxation. [matched] is the matching of a
   larger problem, or is full of -1. What is still available in it is still of least cost, hence only cliques that
   lost a pair are solved again, in place. Rows with too few vehicles are the error. *)
let relax search weights matched =
  let is_intact = Array.for_all (fun row -> matched.(row) >= 0 && is_available search row matched.(row)) in
  let solve clique =
    let weight row column =
      if is_available search row column then weights.((row * search.width) + column) else forbidden
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

(* No solution of what is open has fewer vehicles. [All_different] adds up its branches, and one more for each that
   could be served by one vehicle alone, but not at once with the others; [Any] takes the greatest part, or rows
   that have no vehicle in common. *)
let least_vehicles search sizes =
  let scarce_first rows = List.stable_sort (fun a b -> Int.compare sizes.(a) sizes.(b)) rows in
  let inner node kind children =
    match kind with
    | Shape.A_leaf _ | Any ->
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
  let needs = Shape.bottom_up search.part.shape ~leaf:(fun row -> (1, Some [ row ])) ~inner in
  max search.used (fst needs.(0))

(* {2 Search} *)

(* [explore search weights ~bound ~is_enough matched] goes through the allocations that complete [assigned] with at
   most [limit] vehicles, and finds the one of least weight, if it is below [bound]; or any of these, if that
   [is_enough]. The second result is whether it came to its end before the steps came to [ceiling]. [matched] is as for
   [relax]. *)
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
    if !(search.spent) > search.ceiling then raise_notrace Exhausted;
    match relax search weights matched with
    | Error _ -> ()
    | Ok () ->
      let weight = cost_of search weights matched in
      if weight < !bound then begin
        let sizes = domain_sizes search in
        if least_vehicles search sizes <= search.limit then
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

let nothing_matched search = Array.make search.rows (-1)

(* Weights that make every clique prefer the same vehicles: those that can serve most rows. *)
let sharing_weights search =
  let served column =
    let count = ref 0 in
    for row = 0 to search.rows - 1 do
      if search.part.cost.((row * search.width) + column) < forbidden then incr count
    done;
    !count
  in
  let served = Array.init search.width served in
  let order = Array.init search.width Fun.id in
  Array.stable_sort (fun a b -> Int.compare served.(b) served.(a)) order;
  let rank = Array.make search.width 0 in
  Array.iteri (fun place column -> rank.(column) <- place) order;
  Array.init (search.rows * search.width) (fun place -> rank.(place mod search.width))

let release search = Array.iteri (fun row column -> if column >= 0 then unassign search row) search.assigned

(* A feasible allocation, found clique by clique with few further vehicles, if that works out. *)
let greedy search weights =
  let weight row column =
    if not (is_available search row column) then forbidden
    else if search.uses.(column) > 0 then 0
    else search.width + weights.((row * search.width) + column)
  in
  let serve clique =
    match match_clique search clique weight with
    | Error _ -> false
    | Ok columns ->
      Array.iteri (fun place column -> assign search clique.(place) column) columns;
      true
  in
  let is_served = Array.for_all serve search.cliques in
  let allocation = Array.copy search.assigned in
  release search;
  if is_served then Some allocation else None

(* [polish search allocation] costs no more than [allocation], and uses no more vehicles: cliques are served anew
   with the vehicles in use, then vehicles change places with others, until nothing gets better. *)
let polish search allocation =
  let cost = search.part.cost in
  let cost_at row column = cost.((row * search.width) + column) in
  let in_use = Array.make search.width false in
  let serve_anew clique =
    Array.iter (fun row -> unassign search row) clique;
    let weight row column =
      if in_use.(column) && search.blocked.((row * search.width) + column) = 0 then cost_at row column else forbidden
    in
    match match_clique search clique weight with
    | Ok columns -> Array.iteri (fun place column -> assign search clique.(place) column) columns
    | Error _ -> assert false (* what was there is one way *)
  in
  let replace column =
    let rows = List.filter (fun row -> search.assigned.(row) = column) (List.init search.rows Fun.id) in
    let total column =
      List.fold_left
        (fun sum row ->
           let c = cost_at row column in
           if sum >= forbidden || c >= forbidden then forbidden else sum + c)
        0 rows
    in
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

(* {2 Branches that need several vehicles}

   If the branches of the root exclude each other, and have no [All_different] inside, all that is hard is which rows of
   a branch share a vehicle. Once that is settled for all branches, the rest is one assignment problem. *)

let rec partitions = function
  | [] -> [ [] ]
  | row :: rows ->
    let rec join before = function
      | [] -> []
      | block :: after -> List.rev_append before ((row :: block) :: after) :: join (block :: before) after
    in
    List.concat_map (fun blocks -> ([ row ] :: blocks) :: join [] blocks) (partitions rows)

(* A set of rows that share a vehicle, and what it costs by column. *)
type block = { members : int list; costs : int array }

(* A branch: its partitions into blocks, the fewest blocks first; how many these are; and costs by column that bound
   those of the branch from below if its first row has the column. *)
type choice = { ways : block list list; fewest : int; relaxed : int array }

let choice_of search rows =
  let cost row column = search.part.cost.((row * search.width) + column) in
  let sum members column =
    let add sum row =
      let c = cost row column in
      if sum >= forbidden || c >= forbidden then forbidden else sum + c
    in
    List.fold_left add 0 members
  in
  let block members =
    let members = List.sort Int.compare members in
    { members; costs = Array.init search.width (sum members) }
  in
  let is_possible { costs; _ } = Array.exists (fun c -> c < forbidden) costs in
  let by_count a b = List.compare_lengths a b in
  let by_first a b = Int.compare (List.hd a.members) (List.hd b.members) in
  let ways =
    partitions rows
    |> List.map (List.map block)
    |> List.filter (List.for_all is_possible)
    |> List.map (List.sort by_first) |> List.stable_sort by_count
  in
  let least row = Array.fold_left min forbidden (Array.init search.width (cost row)) in
  let others = List.fold_left (fun sum row -> sum + least row) 0 (List.tl rows) in
  let relaxed =
    Array.init search.width (fun column ->
        let c = cost (List.hd rows) column in
        if c >= forbidden then forbidden else c + others)
  in
  { ways; fewest = List.length (List.hd ways); relaxed }

let largest_branch = 5 (* which has 52 partitions *)

(* [by_partitions search allocation] is the best of the allocations with as many vehicles as [allocation], and whether
   all of them have been considered. *)
let by_partitions search allocation =
  match Shape.simple_branches search.part.shape with
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
      if !(search.spent) > search.ceiling then raise_notrace Exhausted;
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
        match Matching.solve ~spent:search.spent ~rows ~columns:search.width matrix with
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
              let column_of = Matching.in_pick_order ~rows ~columns:search.width matrix matching in
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

(* {2 The phases: any allocation, the fewest vehicles, the least cost, pick order} *)

let rec fewest_vehicles search weights ~least allocation =
  let count = count_of allocation in
  if count <= least then (allocation, true)
  else begin
    search.limit <- count - 1;
    match explore search weights ~bound:max_int ~is_enough:true (nothing_matched search) with
    | Some fewer, _ -> fewest_vehicles search weights ~least fewer
    | None, is_complete -> (allocation, is_complete)
  end

let least_cost search allocation =
  let cost = search.part.cost in
  search.limit <- count_of allocation;
  let bound = cost_of search cost allocation in
  let better, is_complete = explore search cost ~bound ~is_enough:false (nothing_matched search) in
  (Option.value better ~default:allocation, is_complete)

(* Row by row, the lowest column with which some allocation has as few vehicles and costs as little. *)
let pick_order search allocation =
  let cost = search.part.cost in
  search.limit <- count_of allocation;
  let bound = cost_of search cost allocation + 1 in
  let best = ref allocation and is_complete = ref true in
  let matched = nothing_matched search in
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
    if !is_complete then ignore (relax search cost matched)
  in
  for row = 0 to search.rows - 1 do
    settle row
  done;
  release search;
  (!best, !is_complete)

(* Any allocation, for which no more than [ceiling] steps are made. *)
let any_allocation search weights ~ceiling =
  match relax search weights (nothing_matched search) with
  | Error rows -> Impossible (Some (List.map (fun row -> search.part.groups.(row)) rows))
  | Ok () -> (
      match greedy search weights with
      | Some allocation -> Found allocation
      | None -> (
          search.ceiling <- ceiling;
          match explore search weights ~bound:max_int ~is_enough:true (nothing_matched search) with
          | Some allocation, _ -> Found allocation
          | None, true -> Impossible None
          | None, false -> Undecided))

(* Some of the leaves of [part], which has no allocation, that have none either: leaves are left out one by one, the
   last first, as long as the rest is found to have none within [budget] steps. *)
let smaller_conflict ~restricted ~spent ~budget candidates part =
  let ceiling = !spent + budget in
  (* [kept] ascends, [leaves] descends, and all of these are below those. *)
  let rec leave_out kept leaves =
    match leaves with
    | [] -> kept
    | leaf :: leaves ->
      let rest = List.rev_append leaves kept in
      if !spent >= ceiling then List.rev_append leaves (leaf :: kept)
      else
        let search = search_of ~spent (part_of ~restricted candidates (Array.of_list rest)) in
        match any_allocation search (sharing_weights search) ~ceiling with
        | Impossible (Some fewer) -> fewer
        | Impossible None -> leave_out kept leaves
        | Found _ | Undecided -> leave_out (leaf :: kept) leaves
  in
  leave_out [] (List.rev (Array.to_list part.groups))

(* The allocation of [part], by row, and whether it is proven to be the best, after about [budget] steps. *)
let branch_and_bound ~restricted ~spent ~budget candidates part =
  let search = search_of ~spent part in
  let weights = sharing_weights search in
  match any_allocation search weights ~ceiling:max_int with
  | Undecided -> assert false (* there is no ceiling *)
  | Impossible (Some leaves) -> Error leaves
  | Impossible None -> Error (smaller_conflict ~restricted ~spent ~budget candidates part)
  | Found allocation ->
    let start = !spent in
    let until share = search.ceiling <- start + int_of_float (share *. float_of_int budget) in
    let least = least_vehicles search (domain_sizes search) in
    until 0.4;
    let allocation, has_fewest = fewest_vehicles search weights ~least allocation in
    let allocation = polish search allocation in
    until 0.6;
    let allocation, has_least = least_cost search allocation in
    until 0.7;
    let allocation, is_first = if has_least then pick_order search allocation else (allocation, false) in
    if has_fewest && has_least && is_first then Ok (allocation, true)
    else begin
      until 0.9;
      let allocation, is_best = if has_fewest then by_partitions search allocation else (allocation, false) in
      until 1.;
      let allocation = if is_best then allocation else fst (pick_order search allocation) in
      Ok (allocation, is_best)
    end

(* {1 All together} *)

let solve_within ~effort ~vehicles tree =
  let shape, leaves = Shape.of_tree tree in
  let candidates = Array.map (ordered_candidates ~vehicles) leaves in
  let restricted = Shape.restriction shape in
  let spent = ref 0 in
  let result = Array.make (Array.length leaves) (-1) in
  let install part allocation =
    Array.iteri
      (fun row column -> List.iter (fun leaf -> result.(leaf) <- part.columns.(column)) part.members.(row))
      allocation
  in
  let vehicles_of leaves =
    let listed = Array.make vehicles false in
    List.iter (fun leaf -> Array.iter (fun (vehicle, _) -> listed.(vehicle) <- true) candidates.(leaf)) leaves;
    List.filter (fun vehicle -> listed.(vehicle)) (List.init vehicles Fun.id)
  in
  (* [effort] is shared out evenly among the parts that are yet to come. *)
  let rec solve_parts parts ~effort ~proven =
    match parts with
    | [] -> Ok { vehicles = result; proven }
    | part :: others -> (
        let conflict leaves = Error (Conflict { leaves; vehicles = vehicles_of leaves }) in
        match one_vehicle_a_branch ~spent part with
        | Found allocation ->
          install part allocation;
          solve_parts others ~effort ~proven
        | Impossible (Some leaves) -> conflict leaves
        | Impossible None | Undecided -> (
            let before = !spent in
            let budget = effort / List.length parts in
            match branch_and_bound ~restricted ~spent ~budget candidates part with
            | Error leaves -> conflict leaves
            | Ok (allocation, is_best) ->
              install part allocation;
              solve_parts others ~effort:(max 0 (effort - (!spent - before))) ~proven:(proven && is_best)))
  in
  let rec first_without leaf =
    if leaf = Array.length candidates then None
    else if candidates.(leaf) = [||] then Some leaf
    else first_without (leaf + 1)
  in
  match first_without 0 with
  | Some leaf -> Error (No_candidate leaf)
  | None ->
    let parts = List.map (part_of ~restricted candidates) (components ~vehicles candidates) in
    solve_parts parts ~effort ~proven:true

let solve ~vehicles tree =
  Result.map (fun { vehicles; _ } -> vehicles) (solve_within ~effort ~vehicles tree)
