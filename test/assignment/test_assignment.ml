module Assignment = Dolphin_assignment.Assignment
open Assignment

let case name run = Alcotest.test_case name `Quick run

let rec with_leaves f = function
  | Leaf candidates -> Leaf (f candidates)
  | Disjoint children -> Disjoint (List.map (with_leaves f) children)
  | Shared children -> Shared (List.map (with_leaves f) children)

(* Here a leaf is the list of its vehicles, each with its cost. *)
let solve_within ~effort ~vehicles tree = solve_within ~effort ~vehicles (with_leaves listed tree)
let solve ~vehicles tree = solve ~vehicles (with_leaves listed tree)

(* [leaf [ (v, cost); ... ]] and, where costs do not matter, [any [ v; ... ]]. *)
let leaf candidates = Leaf candidates

let any vehicles = leaf (List.map (fun vehicle -> (vehicle, 0.)) vehicles)

let show = function
  | Ok vehicles -> Fmt.str "%a" Fmt.(array ~sep:(any " ") int) vehicles
  | Error failure -> Fmt.str "%a" pp_failure failure

let gives name ~vehicles expected tree = Alcotest.(check string) name expected (show (solve ~vehicles tree))

(* {1 Examples} *)

(* First come, first served would give vehicle 0 to leaf 0, and none to leaf 1. *)
let greedy_fails () =
  gives "leaf 1 wants 0" ~vehicles:2 "1 0" (Disjoint [ any [ 0; 1 ]; any [ 0 ] ]);
  gives "a chain of changes" ~vehicles:4 "3 2 1 0" (Disjoint [ any [ 2; 3 ]; any [ 1; 2 ]; any [ 0; 1 ]; any [ 0 ] ]);
  (* The nearest vehicle first would cost 1 + 100. *)
  gives "cost of both" ~vehicles:2 "1 0"
    (Disjoint [ leaf [ (0, 1.); (1, 2.) ]; leaf [ (0, 5.); (1, 100.) ] ])

let failures () =
  gives "no candidate" ~vehicles:2 "leaf 1 has no candidate" (Disjoint [ any [ 0 ]; any []; any [ 1 ] ]);
  gives "three for two" ~vehicles:4 "leaves 1, 2, 4 cannot all be served by vehicles 0, 1"
    (Disjoint [ any [ 0; 2; 3 ]; any [ 0; 1 ]; Shared [ any [ 0; 1 ]; any [ 2 ] ]; any [ 1; 0 ] ]);
  gives "two for one" ~vehicles:5 "leaves 1, 3 cannot all be served by vehicles 4"
    (Disjoint [ any [ 0; 4 ]; any [ 4 ]; any [ 0; 1 ]; any [ 4 ]; any [ 2 ] ])

(* Any leaves that all exclude each other have vehicles enough, but the six together do not: whatever leaves 0 and 1
   take, one of the others has both. Leaf 6 has nothing to do with it. *)
let conflict_without_clique () =
  let complete_bipartite lists = Disjoint (List.map (fun lists -> Shared (List.map any lists)) lists) in
  gives "K(2,4)" ~vehicles:5 "leaves 0, 1, 2, 3, 4, 5 cannot all be served by vehicles 0, 1, 2, 3"
    (Shared
       [ complete_bipartite [ [ [ 0; 1 ]; [ 2; 3 ] ]; [ [ 0; 2 ]; [ 0; 3 ]; [ 1; 2 ]; [ 1; 3 ] ] ]; any [ 0; 4 ] ])

let sharing_is_preferred () =
  gives "one vehicle in sequence, though dearer" ~vehicles:2 "1 1"
    (Shared [ leaf [ (0, 0.); (1, 1000.) ]; leaf [ (1, 1000.) ] ]);
  gives "two stages" ~vehicles:4 "0 1 0 1"
    (Shared [ Disjoint [ any [ 0; 1; 2 ]; any [ 1; 2 ] ]; Disjoint [ any [ 0; 1; 3 ]; any [ 1; 3 ] ] ]);
  gives "what cannot be one is two, and no more" ~vehicles:3 "0 2 2"
    (Shared [ any [ 0; 1 ]; any [ 1; 2 ]; any [ 2 ] ]);
  gives "survey and station keeping on the same vehicles" ~vehicles:3 "0 0 1 1"
    (Disjoint [ Shared [ any [ 0; 1 ]; any [ 0; 1; 2 ] ]; Shared [ any [ 0; 1 ]; any [ 1; 2 ] ] ])

let distance_decides () =
  gives "crossing ways are uncrossed" ~vehicles:3 "2 0"
    (Disjoint [ leaf [ (0, 10.); (1, 30.); (2, 5.) ]; leaf [ (0, 7.); (1, 40.); (2, 6.) ] ]);
  gives "the whole branch counts" ~vehicles:2 "1 1 0"
    (Disjoint [ Shared [ leaf [ (0, 1.); (1, 2.) ]; leaf [ (0, 9.); (1, 2.) ] ]; leaf [ (0, 3.); (1, 3.) ] ]);
  gives "less than half a millimetre is nothing" ~vehicles:2 "0" (leaf [ (0, 100.0004); (1, 100.) ]);
  gives "an unknown distance is the last resort" ~vehicles:2 "1" (leaf [ (0, Float.infinity); (1, 20e6) ])

let pick_order_decides () =
  gives "ties" ~vehicles:4 "0 1 2" (Disjoint [ any [ 3; 2; 1; 0 ]; any [ 0; 1; 2; 3 ]; any [ 0; 1; 2; 3 ] ]);
  gives "ties, the first leaf first" ~vehicles:3 "0 2 1"
    (Disjoint [ any [ 0; 1; 2 ]; any [ 0; 2 ]; any [ 0; 1 ] ]);
  gives "ties of sums" ~vehicles:2 "0 1" (Disjoint [ leaf [ (0, 4.); (1, 3.) ]; leaf [ (0, 2.); (1, 1.) ] ]);
  gives "a vehicle that is left free" ~vehicles:3 "0 1"
    (Disjoint [ leaf [ (0, 1.); (2, 1.) ]; leaf [ (0, 1.); (1, 1.) ] ])

let odd_trees () =
  gives "nothing" ~vehicles:0 "" (Disjoint []);
  gives "nothing in parts" ~vehicles:1 "0" (Shared [ Disjoint []; Disjoint [ Shared [ any [ 0 ] ]; Shared [] ] ]);
  gives "listed twice" ~vehicles:2 "1" (leaf [ (1, 5.); (0, 2.); (1, 1.) ]);
  let rejects name message tree =
    Alcotest.check_raises name (Invalid_argument message) (fun () -> ignore (solve ~vehicles:1 tree))
  in
  rejects "no such vehicle" "Assignment.solve: no vehicle 1" (any [ 1 ]);
  rejects "negative" "Assignment.solve: a cost of -1" (leaf [ (0, -1.) ]);
  rejects "not a number" "Assignment.solve: a cost of nan" (leaf [ (0, Float.nan) ])

(* Too deep for [with_leaves]. *)
let deep_trees () =
  let any vehicles = Leaf (listed (List.map (fun vehicle -> (vehicle, 0.)) vehicles)) in
  let solve = Assignment.solve in
  let gives name ~vehicles expected tree = Alcotest.(check string) name expected (show (solve ~vehicles tree)) in
  let rec nest count wrap tree = if count = 0 then tree else nest (count - 1) wrap (wrap tree) in
  let all n expected = function
    | Ok vehicles -> Array.length vehicles = n && Array.for_all (( = ) expected) vehicles
    | Error _ -> false
  in
  let first = nest 10_000 (fun tree -> Shared [ tree; any [ 0; 1 ] ]) (any [ 1; 0 ]) in
  let last = nest 10_000 (fun tree -> Shared [ any [ 0; 1 ]; tree ]) (any [ 1 ]) in
  Alcotest.(check bool) "chain to the left" true (all 10_001 0 (solve ~vehicles:2 first));
  Alcotest.(check bool) "chain to the right" true (all 10_001 1 (solve ~vehicles:2 last));
  let lonely = nest 100_000 (fun tree -> Disjoint [ Shared [ tree ] ]) (any [ 0 ]) in
  Alcotest.(check bool) "lonely branches" true (all 1 0 (solve ~vehicles:1 lonely));
  let alternating = nest 300 (fun tree -> Shared [ any [ 0 ]; Disjoint [ any [ 1; 2 ]; tree ] ]) (any [ 0; 3 ]) in
  gives "an alternation has a conflict" ~vehicles:4 "leaves 1, 3, 5 cannot all be served by vehicles 1, 2"
    (nest 2 (fun tree -> Shared [ any [ 0 ]; Disjoint [ any [ 1; 2 ]; tree ] ]) (Disjoint [ any [ 3 ]; any [ 1; 2 ] ]));
  match solve ~vehicles:4 alternating with
  | Ok _ -> Alcotest.fail "three hundred on two vehicles"
  | Error (No_candidate _) -> Alcotest.fail "all have candidates"
  | Error (Conflict { leaves; _ }) -> Alcotest.(check int) "three are too many" 3 (List.length leaves)

(* {1 Large problems}

   The bounds, on processor time, are generous: only another order of growth breaks them. *)

let within_seconds bound run =
  let start = Sys.time () in
  let result = run () in
  let elapsed = Sys.time () -. start in
  if elapsed > bound then Alcotest.failf "took %.1f s" elapsed;
  result

let is_permutation vehicles = List.sort_uniq compare (Array.to_list vehicles) = List.init (Array.length vehicles) Fun.id

let thousand_by_thousand () =
  let numbers = List.init 1000 Fun.id in
  let parallel cost = Disjoint (List.map (fun task -> leaf (List.map (fun v -> (v, cost task v)) numbers)) numbers) in
  let solve tree = within_seconds 5. (fun () -> solve_within ~effort ~vehicles:1000 tree) in
  (match solve (parallel (fun _ _ -> 500.)) with
   | Ok { vehicles; proven } ->
     Alcotest.(check (list int)) "all at one place: pick order" numbers (Array.to_list vehicles);
     Alcotest.(check bool) "proven" true proven
   | Error failure -> Alcotest.failf "%a" pp_failure failure);
  (match solve (parallel (fun task v -> float_of_int (abs (task - (999 - v))))) with
   | Ok { vehicles; _ } -> Alcotest.(check bool) "a permutation" true (is_permutation vehicles)
   | Error failure -> Alcotest.failf "%a" pp_failure failure);
  let random = Random.State.make [| 1 |] in
  let place _ = (Random.State.float random 1e4, Random.State.float random 1e4) in
  let tasks = Array.init 1000 place and places = Array.init 1000 place in
  let cost task v = hypot (fst tasks.(task) -. fst places.(v)) (snd tasks.(task) -. snd places.(v)) in
  match solve (parallel cost) with
  | Ok { vehicles; proven } ->
    Alcotest.(check bool) "a permutation" true (is_permutation vehicles);
    Alcotest.(check bool) "proven" true proven
  | Error failure -> Alcotest.failf "%a" pp_failure failure

(* A matrix of them would have 400 million entries, and too many for the memory of many a console. *)
let twenty_thousand_alike () =
  let n = 20_000 in
  let one = { vehicles = Array.init n Fun.id; metres = None } in
  match Assignment.solve ~vehicles:n (Disjoint (List.init n (fun _ -> Leaf one))) with
  | Ok vehicles -> Alcotest.(check bool) "pick order" true (vehicles = Array.init n Fun.id)
  | Error failure -> Alcotest.failf "%a" pp_failure failure

let effort_is_a_bound () =
  let random = Random.State.make [| 2 |] in
  let any_leaf _ = leaf (List.init 30 (fun v -> (v, Random.State.float random 1000.))) in
  let tree = Shared (List.init 3 (fun _ -> Disjoint (List.init 15 any_leaf))) in
  match within_seconds 5. (fun () -> solve_within ~effort:1_000_000 ~vehicles:30 tree) with
  | Ok { vehicles; proven } ->
    Alcotest.(check bool) "not proven" false proven;
    let used = List.sort_uniq compare (Array.to_list vehicles) in
    Alcotest.(check int) "fifteen vehicles all the same" 15 (List.length used)
  | Error failure -> Alcotest.failf "%a" pp_failure failure

(* {1 All allocations of small problems} *)

(* The leaves, and the pairs of them that exclude each other. *)
let rec flatten first = function
  | Leaf leaf -> ([ leaf ], [], first + 1)
  | Disjoint children -> flatten_all first children ~exclusive:true
  | Shared children -> flatten_all first children ~exclusive:false

and flatten_all first children ~exclusive =
  let add (leaves, pairs, next) child =
    let leaves', pairs', after = flatten next child in
    let across =
      if not exclusive then []
      else
        List.concat_map
          (fun a -> List.init (after - next) (fun index -> (a, next + index)))
          (List.init (next - first) (fun index -> first + index))
    in
    (leaves @ leaves', across @ pairs @ pairs', after)
  in
  List.fold_left add ([], [], first) children

let allocations leaves =
  let extend candidates rest =
    List.concat_map
      (fun (vehicle, cost) -> List.map (fun (vehicles, sum) -> (vehicle :: vehicles, cost +. sum)) rest)
      candidates
  in
  List.fold_right extend leaves [ ([], 0.) ]

let is_allowed pairs vehicles =
  let vehicles = Array.of_list vehicles in
  List.for_all (fun (a, b) -> vehicles.(a) <> vehicles.(b)) pairs

(* The objective, as it is written in the interface. Costs are whole metres here. *)
let best tree =
  let leaves, pairs, _ = flatten 0 tree in
  let value (vehicles, cost) = (List.length (List.sort_uniq compare vehicles), cost, vehicles) in
  allocations leaves
  |> List.filter (fun (vehicles, _) -> is_allowed pairs vehicles)
  |> List.map value |> List.sort compare
  |> function [] -> None | (_, _, vehicles) :: _ -> Some vehicles

let rec pp_tree ppf = function
  | Leaf candidates -> Fmt.pf ppf "[%a]" Fmt.(list ~sep:semi (pair ~sep:(any ":") int float)) candidates
  | Disjoint children -> Fmt.pf ppf "(%a)" Fmt.(list ~sep:(any " | ") pp_tree) children
  | Shared children -> Fmt.pf ppf "(%a)" Fmt.(list ~sep:(any " >> ") pp_tree) children

let tree_generator ~leaves ~vehicles =
  let open QCheck2.Gen in
  let leaf highest =
    let* present = flatten_l (List.init vehicles (fun _ -> int_bound 2)) in
    let* costs = flatten_l (List.init vehicles (fun _ -> int_bound highest)) in
    let candidate vehicle (present, cost) = if present > 0 then Some (vehicle, float_of_int cost) else None in
    let candidates = List.filter_map Fun.id (List.mapi candidate (List.combine present costs)) in
    let+ candidates = if candidates = [] then return [ (0, 1.) ] else shuffle_l candidates in
    Leaf candidates
  in
  let rec tree highest count =
    if count = 1 then leaf highest
    else
      let* first = int_range 1 (count - 1) in
      let* a = tree highest first and* b = tree highest (count - first) in
      let+ disjoint = bool in
      if disjoint then Disjoint [ a; b ] else Shared [ a; b ]
  in
  let* count = int_range 1 leaves in
  let* highest = oneofl [ 0; 1; 3; 50 ] in
  tree highest count

(* The shape of a tree, with one leaf for all. *)
let alike_generator ~leaves ~vehicles =
  let open QCheck2.Gen in
  let rec with_leaf leaf = function
    | Leaf _ -> Leaf leaf
    | Disjoint children -> Disjoint (List.map (with_leaf leaf) children)
    | Shared children -> Shared (List.map (with_leaf leaf) children)
  in
  let+ shape = tree_generator ~leaves ~vehicles and+ one = tree_generator ~leaves:1 ~vehicles in
  match one with Leaf leaf -> with_leaf leaf shape | Disjoint _ | Shared _ -> shape

let conflict_is_real tree leaves =
  let all, pairs, _ = flatten 0 tree in
  let chosen = List.filter (fun (a, b) -> List.mem a leaves && List.mem b leaves) pairs in
  let free index leaf = if List.mem index leaves then leaf else [ (0, 0.) ] in
  let possible = allocations (List.mapi free all) in
  not (List.exists (fun (vehicles, _) -> is_allowed chosen vehicles) possible)

(* Conflicts are minimal: any of the leaves left out, the others can be served. *)
let is_best tree vehicles =
  match (solve_within ~effort ~vehicles tree, best tree) with
  | Ok { vehicles; proven }, Some expected -> proven && Array.to_list vehicles = expected
  | Error (Conflict { leaves; vehicles = _ }), None ->
    conflict_is_real tree leaves
    && List.for_all (fun leaf -> not (conflict_is_real tree (List.filter (( <> ) leaf) leaves))) leaves
  | Error (No_candidate _), _ | Ok _, None | Error (Conflict _), Some _ -> false

(* However early it is stopped, its result is allowed, and the best if it claims to be. *)
let is_honest (tree, effort) vehicles =
  let leaves, pairs, _ = flatten 0 tree in
  match (solve_within ~effort ~vehicles tree, best tree) with
  | Ok { vehicles; proven }, Some expected ->
    let vehicles = Array.to_list vehicles in
    is_allowed pairs vehicles
    && List.for_all2 (fun leaf vehicle -> List.mem_assoc vehicle leaf) leaves vehicles
    && ((not proven) || vehicles = expected)
  | Error (Conflict { leaves; _ }), None -> conflict_is_real tree leaves
  | Error (No_candidate _), _ | Ok _, None | Error (Conflict _), Some _ -> false

(* {1 Large matrices}

   Too large for all allocations to be tried: the duals of a matching prove that it costs least. *)

module Matching = Dolphin_assignment.Matching
module Costs = Dolphin_assignment.Costs

type family = Random | On_a_line | Products | Few_costs

let cost_of family state ~forbidden =
  let random = Random.State.int state in
  let here = Array.init 400 (fun _ -> random 100_000) and there = Array.init 400 (fun _ -> random 1000) in
  fun row column ->
    if random 100 < forbidden then Matching.forbidden
    else
      match family with
      | Random -> random 1_000_000
      | On_a_line -> abs (here.(row) - there.(column))
      | Products -> (row + 1) * (column + 1)
      | Few_costs -> random 3

let matrix (rows, more, family, forbidden, seed) =
  let columns = rows + more and state = Random.State.make [| seed |] in
  let cost = cost_of family state ~forbidden in
  (rows, columns, Array.init (rows * columns) (fun i -> cost (i / columns) (i mod columns)))

let costs_least ~rows ~columns cost (m : Matching.t) =
  let reduced row column =
    let c = cost.((row * columns) + column) in
    if c >= Matching.forbidden then Matching.forbidden else c - m.dual.(column)
  in
  let all = List.init columns Fun.id in
  let is_cheapest row column = List.for_all (fun other -> reduced row column <= reduced row other) all in
  let rows_agree row = m.row_of.(m.column_of.(row)) = row && is_cheapest row m.column_of.(row) in
  let is_dual column = if m.row_of.(column) < 0 then m.dual.(column) = 0 else m.dual.(column) <= 0 in
  List.for_all rows_agree (List.init rows Fun.id) && List.for_all is_dual all

let lacks_columns ~columns cost rows =
  let may row column = cost.((row * columns) + column) < Matching.forbidden in
  let reached = List.filter (fun column -> List.exists (fun row -> may row column) rows) (List.init columns Fun.id) in
  List.compare_lengths reached rows < 0

(* Held in few bytes or in 8 for each cost, the same is found. *)
let large_is_solved problem =
  let rows, columns, cost = matrix problem in
  let solved costs = Result.map (fun m -> (m, Matching.in_pick_order costs m)) (Matching.solve ~spent:(ref 0) costs) in
  let narrow = Costs.make ~rows ~columns (fun row buffer -> Array.blit cost (row * columns) buffer 0 columns) in
  let result = solved (Costs.of_array ~rows ~columns cost) in
  result = solved narrow
  &&
  match result with
  | Ok (m, _) -> costs_least ~rows ~columns cost m
  | Error lacking -> lacks_columns ~columns cost lacking

(* {1 Located plans}

   Costs of pairs are nowhere held, but those of branches, in 3 bytes. *)

let two_thousand_places () =
  let n = 2000 in
  let random = Random.State.make [| 3 |] in
  let place _ = (Random.State.float random 1e4, Random.State.float random 1e4) in
  let here = Array.init n place and vehicles = Array.init n Fun.id in
  let leaf _ =
    let x, y = place () in
    Leaf { vehicles; metres = Some (fun v -> hypot (fst here.(v) -. x) (snd here.(v) -. y)) }
  in
  let tree = Disjoint (List.init n (fun _ -> Shared (List.init 3 leaf))) in
  let before = (Gc.quick_stat ()).heap_words in
  let after = ref before in
  let alarm = Gc.create_alarm (fun () -> after := max !after (Gc.quick_stat ()).heap_words) in
  let result = within_seconds 30. (fun () -> Assignment.solve ~vehicles:n tree) in
  Gc.delete_alarm alarm;
  let megabytes = (max !after (Gc.quick_stat ()).heap_words - before) * 8 / 1_000_000 in
  if megabytes > 60 then Alcotest.failf "took %d MB" megabytes;
  match result with
  | Ok vehicles ->
    let branches = List.init n (fun branch -> vehicles.(3 * branch)) in
    Alcotest.(check bool) "a permutation" true (is_permutation (Array.of_list branches))
  | Error failure -> Alcotest.failf "%a" pp_failure failure

(* Costs that 3 bytes hold, the first that they do not, and so for 4. *)
let far_apart () =
  let gives_far metres =
    gives (Printf.sprintf "%f m" metres) ~vehicles:3 "1 0"
      (Disjoint [ leaf [ (0, 1. +. metres); (1, 1.) ]; leaf [ (0, metres); (1, 0.5) ] ])
  in
  List.iter gives_far [ 16777.213; 16777.214; 16777.215; 4294967.293; 4294967.294; 4294967.295; 9e6 ]

let large_generator =
  let open QCheck2.Gen in
  let family = oneofl [ Random; On_a_line; Products; Few_costs ] and forbidden = oneofl [ 0; 0; 20; 97; 99 ] in
  let* rows = int_range 90 140 in
  let* more = int_range (-1) (rows / 3) and* family = family in
  let* forbidden = forbidden and* seed = int_bound 1_000_000 in
  return (rows, more, family, forbidden, seed)

let print_large (rows, more, _, forbidden, seed) =
  Printf.sprintf "%d rows, %d columns more, %d %% forbidden, seed %d" rows more forbidden seed

let law_of generator print property ~count name = Test_support.Property.case ~count name ~print generator property

let print_tree = Fmt.str "%a" pp_tree

let law ~count name ~leaves ~vehicles =
  law_of (tree_generator ~leaves ~vehicles) print_tree (fun tree -> is_best tree vehicles) ~count name

let law_of_effort ~count name ~leaves ~vehicles =
  let generator = QCheck2.Gen.(pair (tree_generator ~leaves ~vehicles) (int_bound 10_000)) in
  let print (tree, effort) = Fmt.str "%s within %d" (print_tree tree) effort in
  law_of generator print (fun problem -> is_honest problem vehicles) ~count name

let () =
  Alcotest.run "assignment"
    [
      ( "examples",
        [
          case "greedy fails" greedy_fails;
          case "failures" failures;
          case "a conflict without a clique" conflict_without_clique;
          case "sharing is preferred" sharing_is_preferred;
          case "distance decides" distance_decides;
          case "pick order decides" pick_order_decides;
          case "odd trees" odd_trees;
          case "deep trees" deep_trees;
        ] );
      ( "large",
        [
          case "1000 x 1000" thousand_by_thousand;
          case "20,000 alike" twenty_thousand_alike;
          case "2,000 branches of three places" two_thousand_places;
          case "costs far apart" far_apart;
          case "effort is a bound" effort_is_a_bound;
          law_of large_generator print_large large_is_solved ~count:100 "duals prove that a matching costs least";
        ] );
      ( "all allocations",
        [
          law "5 leaves, 4 vehicles" ~count:4000 ~leaves:5 ~vehicles:4;
          law "5 leaves, 2 vehicles" ~count:1000 ~leaves:5 ~vehicles:2;
          law_of (alike_generator ~leaves:5 ~vehicles:4) print_tree (fun tree -> is_best tree 4) ~count:1000
            "5 leaves that are alike, 4 vehicles";
          law "7 leaves, 3 vehicles" ~count:1000 ~leaves:7 ~vehicles:3;
          law_of_effort "stopped early" ~count:2000 ~leaves:6 ~vehicles:4;
        ] );
    ]
