(* Random graphs, and the simplest implementations of the library's functions: the yardstick for the library. *)

open Dolphin_lts

let gen ~states ~labels ~transitions =
  let open QCheck2.Gen in
  let* n = int_range 1 states in
  let* initial = int_bound (n - 1) in
  let state = int_bound (n - 1) in
  let label = map (fun l -> String.make 1 (Char.chr (Char.code 'a' + l))) (int_bound (labels - 1)) in
  let transition = triple state label state in
  let* all = list_size (int_bound transitions) transition in
  return (Graph.of_list ~initial ~states:n all)

let print g = Fmt.str "%a" Graph.pp g
let print_pair (g, h) = print g ^ "\n" ^ print h
let small = gen ~states:7 ~labels:2 ~transitions:14
let sparse = gen ~states:10 ~labels:2 ~transitions:12

let successors g s = Graph.fold_from g s (fun all l s' -> (Graph.label g l, s') :: all) []

(* The greatest relation between states of [g] and [h] in which each matches the other's transitions: by taking out
   pairs until nothing changes. *)
let bisimilarity g h =
  let related = Array.make_matrix (Graph.states g) (Graph.states h) true in
  (* [related] is between states of [g] and [h]; if [flip], [of_s] are moves in [h]. *)
  let matched flip of_s of_t =
    List.for_all
      (fun (l, s') ->
         List.exists (fun (l', t') -> l = l' && if flip then related.(t').(s') else related.(s').(t')) of_t)
      of_s
  in
  let changed = ref true in
  while !changed do
    changed := false;
    Array.iteri
      (fun s row ->
         Array.iteri
           (fun t holds ->
              let of_s = successors g s and of_t = successors h t in
              if holds && not (matched false of_s of_t && matched true of_t of_s) then begin
                related.(s).(t) <- false;
                changed := true
              end)
           row)
      related
  done;
  related

let bisimilar g h = (bisimilarity g h).(Graph.initial g).(Graph.initial h)

(* Whether [trace] is one of [g]. *)
let has_trace g trace =
  let by label s = List.filter_map (fun (l, s') -> if l = label then Some s' else None) (successors g s) in
  let step states label = List.sort_uniq compare (List.concat_map (by label) states) in
  List.fold_left step [ Graph.initial g ] trace <> []

(* The traces of [g] of a length. *)
let rec traces g length =
  let rec from s = function
    | 0 -> [ [] ]
    | n -> List.concat_map (fun (l, s') -> List.map (List.cons l) (from s' (n - 1))) (successors g s)
  in
  if length < 0 then [] else List.sort_uniq compare (traces g (length - 1) @ from (Graph.initial g) length)

let permute permutation g =
  Graph.of_list
    ~initial:permutation.(Graph.initial g)
    ~states:(Graph.states g)
    (List.rev_map (fun (s, l, s') -> (permutation.(s), l, permutation.(s'))) (Graph.to_list g))

let permutation n =
  QCheck2.Gen.map Array.of_list (QCheck2.Gen.shuffle_l (List.init n Fun.id))

let rec permutations = function
  | [] -> [ [] ]
  | all -> List.concat_map (fun x -> List.map (List.cons x) (permutations (List.filter (( <> ) x) all))) all

(* Whether some permutation makes [g] equal [h]. *)
let isomorphic g h =
  Graph.states g = Graph.states h
  && Graph.transitions g = Graph.transitions h
  && List.exists
    (fun permutation -> Graph.equal (permute (Array.of_list permutation) g) h)
    (permutations (List.init (Graph.states g) Fun.id))

let case name run = Alcotest.test_case name `Quick run

let law name ?(count = 1000) ~print gen holds = Test_support.Property.case ~count name ~print gen holds
