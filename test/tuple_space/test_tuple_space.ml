open Dolphin_semantics

module Space = Tuple_space.Make (struct
    include Int

    let hash x = x

    let normal = abs

    let pp = Fmt.int
  end)

let space = Alcotest.testable Space.pp Space.equal

let bindings = Alcotest.(list (pair string (list int)))

let posted order pairs = List.fold_left (fun n (k, x) -> Space.post k x n) (Space.empty order) pairs

(* {1 Examples} *)

let a_multiset () =
  let n = posted Tuple_space.no_key [ ("b", 2); ("a", 1); ("b", 1); ("b", 2) ] in
  Alcotest.check bindings "sorted" [ ("a", [ 1 ]); ("b", [ 1; 2; 2 ]) ] (Space.bindings n);
  Alcotest.(check int) "cardinal" 4 (Space.cardinal n);
  Alcotest.(check string) "printed" "{a:1, b:1, b:2, b:2}" (Fmt.str "%a" Space.pp n);
  let n = Option.get (Space.consume "b" 2 n) in
  Alcotest.check bindings "one of two" [ ("a", [ 1 ]); ("b", [ 1; 2 ]) ] (Space.bindings n);
  Alcotest.(check bool) "none left" true (Space.consume "a" 7 n = None)

let the_order_is_kept_where_it_shows () =
  let order = Tuple_space.keys [ "b" ] in
  let first = posted order [ ("b", 2); ("a", 1); ("a", 2); ("b", 1) ] in
  let second = posted order [ ("a", 2); ("b", 1); ("b", 2); ("a", 1) ] in
  Alcotest.check bindings "oldest first" [ ("a", [ 1; 2 ]); ("b", [ 2; 1 ]) ] (Space.bindings first);
  Alcotest.(check bool) "order differs" false (Space.equal first second);
  let oldest n = fst (Option.get (Space.consume_oldest "b" n)) in
  Alcotest.(check (pair int int)) "oldest" (2, 1) (oldest first, oldest second);
  let without_b n = Option.bind (Space.consume "b" 1 n) (Space.consume "b" 2) in
  Alcotest.(check (option space)) "alike without b" (without_b first) (without_b second);
  Alcotest.check_raises "no order kept" (Invalid_argument "Tuple_space.consume_oldest: key a is not ordered")
    (fun () -> ignore (Space.consume_oldest "a" first))

let history_is_forgotten () =
  let direct = posted Tuple_space.every_key [ ("k", 5); ("k", 6) ] in
  let roundabout = posted Tuple_space.every_key [ ("k", 4); ("k", 5); ("k", 9); ("k", 6); ("l", 1) ] in
  let roundabout =
    snd (Option.get (Space.consume_oldest "k" roundabout))
    |> Space.consume "k" 9 |> Option.get |> Space.consume "l" 1 |> Option.get
  in
  Alcotest.check space "equal" direct roundabout;
  Alcotest.(check int) "same hash" (Space.hash direct) (Space.hash roundabout)

let equal_values_are_one_pair () =
  let n = posted (Tuple_space.keys [ "b" ]) [ ("a", 1); ("a", -1); ("b", -2); ("b", 3); ("b", 2) ] in
  Alcotest.check bindings "normal where counted, as posted where in order" [ ("a", [ 1; 1 ]); ("b", [ -2; 3; 2 ]) ]
    (Space.bindings n);
  Alcotest.(check bool) "seen" true (Space.poll "a" (-1) n && Space.poll "b" 2 n && Space.poll "b" (-3) n);
  let n = Option.get (Option.bind (Space.consume "a" (-1) n) (Space.consume "b" 2)) in
  Alcotest.check bindings "the oldest that is equal" [ ("a", [ 1 ]); ("b", [ 3; 2 ]) ] (Space.bindings n)

(* {1 The model: a list of pairs, the oldest first} *)

type operation = Post of string * int | Consume of string * int | Oldest of string

let ordered_keys = [ "a"; "c" ]

let without_oldest matches pairs =
  let rec remove before = function
    | [] -> None
    | pair :: after when matches pair -> Some (snd pair, List.rev_append before after)
    | pair :: after -> remove (pair :: before) after
  in
  remove [] pairs

let model_bindings pairs =
  let values k =
    let values = List.filter_map (fun (k', x) -> if k = k' then Some x else None) pairs in
    if List.mem k ordered_keys then values else List.sort compare values
  in
  List.sort_uniq compare (List.map fst pairs) |> List.map (fun k -> (k, values k))

let agree pairs n =
  model_bindings pairs = Space.bindings n
  && List.length pairs = Space.cardinal n
  && List.for_all
    (fun k ->
       Space.poll_any k n = List.mem_assoc k pairs
       && List.for_all (fun x -> Space.poll k x n = List.mem (k, x) pairs) [ 0; 1; 2 ])
    [ "a"; "b"; "c"; "d" ]

let step (pairs, n) operation =
  match operation with
  | Post (k, x) -> Some (pairs @ [ (k, x) ], Space.post k x n)
  | Consume (k, x) -> (
      match (without_oldest (( = ) (k, x)) pairs, Space.consume k x n) with
      | None, None -> Some (pairs, n)
      | Some (_, pairs), Some n -> Some (pairs, n)
      | None, Some _ | Some _, None -> None)
  | Oldest k -> (
      match (without_oldest (fun (k', _) -> k = k') pairs, Space.consume_oldest k n) with
      | None, None -> Some (pairs, n)
      | Some (x, pairs), Some (x', n) -> if x = x' then Some (pairs, n) else None
      | None, Some _ | Some _, None -> None)

let operation_generator =
  let open QCheck2.Gen in
  let key = oneofl [ "a"; "b"; "c" ] and value = int_bound 2 in
  frequency
    [
      (4, map2 (fun k x -> Post (k, x)) key value);
      (2, map2 (fun k x -> Consume (k, x)) key value);
      (1, map (fun k -> Oldest k) (oneofl ordered_keys));
    ]

let operations = QCheck2.Gen.(list_size (int_bound 25) operation_generator)

let pp_operation ppf = function
  | Post (k, x) -> Fmt.pf ppf "post %s:%d" k x
  | Consume (k, x) -> Fmt.pf ppf "consume %s:%d" k x
  | Oldest k -> Fmt.pf ppf "consume %s:_" k

let start = ([], Space.empty (Tuple_space.keys ordered_keys))

let run operations =
  List.fold_left
    (fun state operation ->
       match state with
       | None -> None
       | Some state -> (
           match step state operation with
           | Some (pairs, n) when agree pairs n -> Some (pairs, n)
           | Some _ | None -> None))
    (Some start) operations

let behaves_like_the_model operations = Option.is_some (run operations)

(* Spaces are equal if and only if the program-visible part of the model is; then their hashes are equal too. *)
let equal_as_the_model (first, second) =
  match (run first, run second) with
  | Some (pairs, n), Some (pairs', n') ->
    let rebuilt = List.fold_left (fun n (k, x) -> Space.post k x n) (snd start) pairs in
    let alike = model_bindings pairs = model_bindings pairs' in
    Space.equal rebuilt n
    && Space.hash rebuilt = Space.hash n
    && Space.equal n n' = alike
    && ((not alike) || Space.hash n = Space.hash n')
    && Int.compare 0 (Space.compare n n') = Space.compare n' n
  | None, _ | _, None -> false

(* The parts that [changed] leaves out are in both, and a posted value is stored in the form of [kept]. *)
let changed_keeps_the_balance (first, second) =
  match run first with
  | None -> false
  | Some (_, before) ->
    let post n operation =
      match operation with Post (k, x) -> Space.post k x n | Consume _ | Oldest _ -> n
    in
    let consume n = function
      | Post _ -> n
      | Consume (k, x) -> Option.value (Space.consume k x n) ~default:n
      | Oldest k -> Option.fold (Space.consume_oldest k n) ~none:n ~some:snd
    in
    let after = List.fold_left consume (List.fold_left post before second) second in
    let gone, come = Space.changed ~before ~after in
    let values k all = Option.value (List.assoc_opt k all) ~default:[] in
    let is_right k =
      let old_values = Space.values k before and new_values = Space.values k after in
      if List.mem_assoc k gone || List.mem_assoc k come then values k gone = old_values && values k come = new_values
      else old_values = new_values
    in
    let is_kept = function
      | Post (k, x) -> List.mem (Space.kept k x before) (Space.values k (Space.post k x before))
      | Consume _ | Oldest _ -> true
    in
    let untouched = Space.changed ~before ~after:(Space.post "new" 1 before) in
    List.for_all is_right [ "a"; "b"; "c" ]
    && List.for_all is_kept second
    && untouched = ([ ("new", []) ], [ ("new", [ 1 ]) ])

let case name run = Alcotest.test_case name `Quick run

let law name = Test_support.Property.case ~count:2000 name

let () =
  let print = Fmt.str "%a" Fmt.(list ~sep:semi pp_operation) in
  let print_both (first, second) = print first ^ " | " ^ print second in
  let few = QCheck2.Gen.(list_size (int_bound 5) operation_generator) in
  Alcotest.run "tuple space"
    [
      ( "examples",
        [
          case "a multiset" a_multiset;
          case "the order is kept where it shows" the_order_is_kept_where_it_shows;
          case "history is forgotten" history_is_forgotten;
          case "equal values are one pair" equal_values_are_one_pair;
        ] );
      ( "laws",
        [
          law "behaves like a list" operations ~print behaves_like_the_model;
          law "equality is that of the model" (QCheck2.Gen.pair few few) ~print:print_both equal_as_the_model;
          law "changed and kept agree with bindings" (QCheck2.Gen.pair operations few) ~print:print_both
            changed_keeps_the_balance;
        ] );
    ]
