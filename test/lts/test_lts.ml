(* Partition, Compare, Isomorphism, Reachability: on examples of the books, and against the simplest
   implementation on random graphs. *)

open Dolphin_lts
open Generate

let strings = Alcotest.(list string)

(* {1 Examples} *)

(* a.(b + c) and a.b + a.c: the choice comes after the coin, or with it. *)
let late = Graph.of_list [ (0, "coin", 1); (1, "coffee", 2); (1, "tea", 3) ]
let early = Graph.of_list [ (0, "coin", 1); (0, "coin", 2); (1, "coffee", 3); (2, "tea", 4) ]

let difference left right =
  match Compare.strong left right with
  | Ok () -> Alcotest.fail "bisimilar"
  | Error difference -> difference

let show left right = Fmt.str "%a" Compare.pp_difference (difference left right)

let coffee () =
  Alcotest.(check string) "late against early"
    "Only the left one satisfies not <coin> not <tea>\nThey have the same traces, but choose at different times."
    (show late early);
  Alcotest.(check string) "early against late"
    "Only the left one satisfies <coin> not <tea>\nThey have the same traces, but choose at different times."
    (show early late);
  Alcotest.(check int) "three kinds of states" 3 (Partition.blocks (Partition.strong late))

(* A machine that gives tea always, and one that after a coffee is out of order. *)
let vending () =
  let sound = Graph.of_list [ (0, "coin", 1); (1, "coffee", 0); (1, "tea", 0) ] in
  let broken = Graph.of_list [ (0, "coin", 1); (1, "coffee", 2); (1, "tea", 0) ] in
  Alcotest.(check string) "the second does not go on"
    "Only the left one satisfies <coin> <coffee> <coin>\nOnly the left one has the trace coin coffee coin"
    (show sound broken);
  let unrolled =
    Graph.of_list [ (0, "coin", 1); (1, "coffee", 2); (1, "tea", 0); (2, "coin", 3); (3, "coffee", 0); (3, "tea", 2) ]
  in
  Alcotest.(check bool) "twice round is once round" true (Compare.strong sound unrolled = Ok ());
  Alcotest.(check bool) "its quotient is the machine" true (Graph.equal sound (Partition.minimal unrolled))

(* Milner's vending machines, with a conjunction. *)
let conjunction () =
  let some =
    Graph.of_list [ (0, "a", 1); (0, "a", 2); (0, "a", 3); (1, "b", 4); (2, "c", 4); (3, "b", 4); (3, "c", 4) ]
  in
  let fewer = Graph.of_list [ (0, "a", 1); (0, "a", 2); (1, "b", 4); (2, "c", 4) ] in
  Alcotest.(check string) "both at once"
    "Only the left one satisfies <a>(<b> and <c>)\nThey have the same traces, but choose at different times."
    (show some fewer)

let unreachable_states_do_not_matter () =
  let more = Graph.of_list [ (0, "coin", 1); (1, "coffee", 2); (1, "tea", 3); (4, "bang", 0) ] in
  Alcotest.(check bool) "bisimilar" true (Compare.strong late more = Ok ());
  match Compare.isomorphic late more with
  | Ok () -> Alcotest.fail "isomorphic"
  | Error { states; _ } -> Alcotest.(check (pair int int)) "but not isomorphic" (4, 5) states

let isomorphism () =
  let shows name expected left right =
    match Compare.isomorphic left right with
    | Ok () -> Alcotest.fail "isomorphic"
    | Error difference ->
      Alcotest.(check string) name expected (Fmt.str "%a" Isomorphism.pp_difference difference)
  in
  let chain = Graph.of_list [ (0, "a", 1); (1, "b", 2); (2, "c", 3) ] in
  let other = Graph.of_list [ (0, "a", 1); (1, "b", 2); (2, "d", 3) ] in
  shows "labels"
    "left: 4 states, 3 transitions; right: 4 states, 3 transitions\n\
     After a b the left one can do c, the right one d."
    chain other;
  let ring = Graph.of_list [ (0, "a", 1); (1, "a", 0) ] and loop = Graph.of_list [ (0, "a", 0) ] in
  shows "an unrolled ring"
    "left: 2 states, 2 transitions; right: 3 states, 3 transitions\n\
     After a a the left one is in the same state as after a, the other is not."
    (Graph.of_list [ (0, "a", 1); (1, "a", 1) ]) (Graph.of_list [ (0, "a", 1); (1, "a", 2); (2, "a", 2) ]);
  Alcotest.(check bool) "and the other way" true (Result.is_error (Compare.isomorphic ring loop));
  shows "what can be told by counting only"
    "left: 5 states, 4 transitions; right: 4 states, 4 transitions\n\
     After a b the left one is in a state\n\
     with 2 similar states on the left and 0 on the right, \
     compared over 1 steps."
    (Graph.of_list [ (0, "a", 1); (0, "a", 2); (1, "b", 3); (2, "b", 4) ])
    (Graph.of_list [ (0, "a", 1); (0, "a", 2); (1, "b", 3); (2, "b", 3) ])

(* Graphs that colours cannot distinguish: a ring of six and two rings of three, hung on one initial state. *)
let symmetric () =
  let rings sizes =
    let start = ref 1 in
    let ring size =
      let first = !start in
      start := first + size;
      List.concat
        (List.init size (fun i ->
             let s = first + i and s' = first + ((i + 1) mod size) in
             [ (0, "hub", s); (s, "next", s'); (s', "next", s) ]))
    in
    Graph.of_list (List.concat_map ring sizes)
  in
  let reason left right =
    match Compare.isomorphic left right with Ok () -> None | Error { reason; _ } -> Some reason
  in
  Alcotest.(check bool) "one ring is not two" true (reason (rings [ 6 ]) (rings [ 3; 3 ]) = Some No_matching);
  Alcotest.(check bool) "order does not matter" true (reason (rings [ 3; 5; 4; 3 ]) (rings [ 4; 3; 3; 5 ]) = None)

let reachability () =
  let g = Graph.of_list ~initial:3 [ (3, "a", 1); (1, "b", 0); (3, "c", 2); (2, "d", 3); (5, "e", 4) ] in
  Alcotest.(check (list bool)) "reachable" [ true; true; true; true; false; false ]
    (Array.to_list (Reachability.reachable g));
  Alcotest.(check (option strings)) "shortest run" (Some [ "a"; "b" ])
    (Option.map Reachability.trace (Reachability.shortest g (Int.equal 0)));
  Alcotest.(check (option strings)) "none" None (Option.map Reachability.trace (Reachability.shortest g (Int.equal 4)));
  Alcotest.(check int) "trimmed" 4 (Graph.states (Reachability.trim g));
  Alcotest.(check bool) "trimmed, but the same" true (Compare.strong g (Reachability.trim g) = Ok ())

(* {1 Laws} *)

let pairs = QCheck2.Gen.pair small small

(* A graph and one that was made from it by a little change: near misses are more telling than strangers. *)
let near =
  let open QCheck2.Gen in
  let* g = oneof [ small; sparse ] in
  let all = Graph.to_list g in
  let* i = int_bound (List.length all) and* s' = int_bound (Graph.states g - 1) in
  let changed = List.mapi (fun j (s, l, target) -> (s, l, if i = j then s' else target)) all in
  return (g, Graph.of_list ~initial:(Graph.initial g) ~states:(Graph.states g) changed)

let partition_is_bisimilarity g =
  let related = bisimilarity g g and p = Partition.strong g in
  let agree s t = related.(s).(t) = (Partition.block p s = Partition.block p t) in
  let states = List.init (Graph.states g) Fun.id in
  List.for_all (fun s -> List.for_all (agree s) states) states

let quotient_is_smallest g =
  let p = Partition.strong g in
  let quotient = Partition.quotient g p in
  bisimilar g quotient
  && Graph.states quotient = Partition.blocks p
  && Partition.blocks (Partition.strong quotient) = Graph.states quotient
  && bisimilar g (Partition.minimal g)
  && Partition.blocks (Partition.strong (Partition.minimal g)) = Graph.states (Partition.minimal g)

let minimal_graphs_are_isomorphic (g, h) =
  bisimilar g h = (Compare.isomorphic (Partition.minimal g) (Partition.minimal h) = Ok ())

let comparison_is_bisimilarity (g, h) =
  match Compare.strong g h with
  | Ok () -> bisimilar g h && Compare.strong h g = Ok ()
  | Error { formula; _ } ->
    (not (bisimilar g h))
    && Modal_formula.holds g (Graph.initial g) formula
    && (not (Modal_formula.holds h (Graph.initial h) formula))
    && Modal_formula.depth (difference h g).formula = Modal_formula.depth formula

(* The formula is not deeper than the number of steps for which the initial states are bisimilar, plus one. *)
let formula_is_least_deep (g, h) =
  let rec similar n s t =
    n = 0
    ||
    let matched one other swap =
      List.for_all
        (fun (l, s') ->
           List.exists (fun (l', t') -> l = l' && if swap then similar (n - 1) t' s' else similar (n - 1) s' t') other)
        one
    in
    let of_s = successors g s and of_t = successors h t in
    matched of_s of_t false && matched of_t of_s true
  in
  match Compare.strong g h with
  | Ok () -> true
  | Error { formula; _ } ->
    let depth = Modal_formula.depth formula in
    depth > 6
    || (similar (depth - 1) (Graph.initial g) (Graph.initial h)
        && not (similar depth (Graph.initial g) (Graph.initial h)))

let traces_are_as_said (g, h) =
  match Compare.strong g h with
  | Ok () -> true
  | Error { traces = Same; _ } -> traces g 5 = traces h 5
  | Error { traces = Not_known; _ } -> false
  | Error { traces = Only (side, trace); _ } ->
    let this, other = match side with Compare.Left -> (g, h) | Right -> (h, g) in
    let shorter = min 5 (List.length trace - 1) in
    has_trace this trace && (not (has_trace other trace)) && traces g shorter = traces h shorter

let permuted =
  let open QCheck2.Gen in
  let* g = gen ~states:9 ~labels:2 ~transitions:14 in
  let* p = permutation (Graph.states g) in
  return (g, permute p g)

let tiny_near =
  let open QCheck2.Gen in
  let* g = gen ~states:5 ~labels:2 ~transitions:8 in
  let all = Graph.to_list g in
  let* i = int_bound (List.length all) and* s' = int_bound (Graph.states g - 1) in
  let changed = List.mapi (fun j (s, l, target) -> (s, l, if i = j then s' else target)) all in
  let changed = Graph.of_list ~initial:(Graph.initial g) ~states:(Graph.states g) changed in
  let* p = permutation (Graph.states g) in
  return (g, permute p changed)

(* A difference is correct: its trace belongs to the graph that it names. *)
let difference_is_so g h = function
  | { Isomorphism.reason = Enabled { trace; left; right }; _ } ->
    has_trace g trace && has_trace h trace && left <> right
  | { reason = Merged { trace; other; _ }; _ } ->
    List.for_all (fun x -> has_trace g x && has_trace h x) [ trace; other ]
  | { reason = Unmatched { side; trace; left; right; _ }; _ } -> (
      left <> right
      && match trace with None -> true | Some trace -> has_trace (match side with Left -> g | Right -> h) trace)
  | { reason = No_matching; _ } -> true
  | { reason = Undecided; _ } -> false

let isomorphism_is_by_permutation (g, h) =
  match Compare.isomorphic g h with
  | Ok () -> isomorphic g h
  | Error difference -> (not (isomorphic g h)) && difference_is_so g h difference

let () =
  Alcotest.run "lts"
    [
      ( "examples",
        [
          case "coffee machines" coffee;
          case "vending machines" vending;
          case "a conjunction" conjunction;
          case "unreachable states" unreachable_states_do_not_matter;
          case "isomorphism" isomorphism;
          case "symmetric graphs" symmetric;
          case "reachability" reachability;
        ] );
      ( "laws",
        [
          law "blocks are the classes of bisimilarity" ~print small partition_is_bisimilarity;
          law "also in sparse graphs" ~print sparse partition_is_bisimilarity;
          law "the quotient is bisimilar and smallest" ~print small quotient_is_smallest;
          law "minimal graphs are isomorphic exactly if bisimilar" ~print:print_pair near minimal_graphs_are_isomorphic;
          law "comparison, and the formula tells apart" ~print:print_pair near comparison_is_bisimilarity;
          law "also of strangers" ~print:print_pair pairs comparison_is_bisimilarity;
          law "no formula is less deep" ~print:print_pair near formula_is_least_deep;
          law "traces are as said, and shortest" ~print:print_pair near traces_are_as_said;
          law "a permuted graph is isomorphic" ~print:print_pair permuted (fun (g, h) ->
              Compare.isomorphic g h = Ok ());
          law "isomorphic exactly if some permutation does it" ~print:print_pair tiny_near
            isomorphism_is_by_permutation;
        ] );
    ]
