open Dolphin_semantics

type exchange = (int, int) Hashtbl.t
type orbit = int array array

type t = {
  orbits : orbit list;
  labels : (Task_isomorphism.label * Task_isomorphism.label) list;
  exchanges : exchange list;
}

(* {1 Renaming pairs} *)

(* Only pairs of one key are exchanged: a request for any pair of a key gets the same. *)
let renamed skeletons rename tuples =
  let again before (k, xs) =
    List.fold_left
      (fun (before, same) x ->
         let n = Skeleton.pair skeletons k x in
         let n' = rename n in
         let x' = if n = n' then x else Skeleton.value_of skeletons n' in
         (Tuples.post k x' before, same && n = n'))
      before xs
  in
  let without =
    List.fold_left
      (fun n (k, xs) ->
         List.fold_left (fun n x -> match Tuples.consume k x n with Some n -> n | None -> n) n xs)
      tuples (Tuples.bindings tuples)
  in
  let again, same = List.fold_left again (without, true) (Tuples.bindings tuples) in
  if same then tuples else again

let apply exchange n = Option.value (Hashtbl.find_opt exchange n) ~default:n
let is_fixed skeletons exchange tuples = Tuples.equal tuples (renamed skeletons (apply exchange) tuples)
let fixes skeletons found tuples = List.for_all (fun exchange -> is_fixed skeletons exchange tuples) found.exchanges

let movable context r =
  let skeletons = Task_isomorphism.skeletons context in
  let of_code (handler, code) = (Skeleton.of_code skeletons ~handler code).fixed in
  let add fixed code = Footprint.Pairs.union fixed (of_code code) in
  let fixed = List.fold_left add Footprint.Pairs.empty (Task_isomorphism.closures r) in
  fun n ->
    let pair = (Skeleton.key_of skeletons n, Some (Skeleton.value_of skeletons n)) in
    not (Footprint.Pairs.meet (Footprint.Pairs.singleton pair) fixed)

let is_clear context r =
  let clear (handler, code) = not (Skeleton.of_code (Task_isomorphism.skeletons context) ~handler code).unclear in
  List.for_all clear (Task_isomorphism.closures r)

(* {1 Subtasks that stand side by side} *)

(* Those with the same [key] may be isomorphic. *)
type subtask = { pairs : int array; labels : Task_isomorphism.label list; key : string }

let subtasks context r =
  let skeletons = Task_isomorphism.skeletons context in
  let pair n = Skeleton.key_of skeletons n and label _ = "" in
  let subtask r =
    let key = Task_isomorphism.key context ~sorted:false ~pair ~label r in
    { pairs = Task_isomorphism.pairs context r; labels = Task_isomorphism.labels r; key }
  in
  let of_branch b = subtask (Residual.One_of [ b ]) in
  let rec lists (r : Residual.t) =
    match r with
    | Repeat _ -> []
    | r -> beside r @ List.concat_map lists (Residual.parts r)
  and beside = function
    | Parallel bs -> [ List.map subtask (Branches.to_list bs) ]
    | All_of (_, bs) | One_of bs -> [ List.map of_branch bs ]
    | _ -> []
  in
  lists r

let by_key subtasks =
  let groups = Hashtbl.create 16 in
  let add order subtask =
    match Hashtbl.find_opt groups subtask.key with
    | Some same -> same := subtask :: !same; order
    | None ->
      let same = ref [ subtask ] in
      Hashtbl.add groups subtask.key same;
      same :: order
  in
  let order = List.rev (List.fold_left add [] subtasks) in
  List.map (fun same -> List.rev !same) order

(* {1 Exchanges} *)

(* The renaming that makes each of [a] and [b] the other. *)
let exchange is_movable a b : exchange option =
  let map = Hashtbl.create 8 in
  let rec from i =
    if i = Array.length a then Some map
    else
      let p = a.(i) and q = b.(i) in
      let agrees x y = match Hashtbl.find_opt map x with Some z -> z = y | None -> true in
      if not (agrees p q && agrees q p) || (p <> q && not (is_movable p && is_movable q)) then None
      else begin
        Hashtbl.replace map p q;
        Hashtbl.replace map q p;
        from (i + 1)
      end
  in
  from 0

(* If the task is the same after the exchange, there is an automorphism that swaps [a] and [b], and maps the other
   subtasks according to [matched]. *)
let checked context is_movable r ns a b =
  let fixes map = List.for_all (is_fixed (Task_isomorphism.skeletons context) map) ns in
  match exchange is_movable a.pairs b.pairs with
  | Some map when fixes map ->
    let moves (l, l') = l <> l' in
    let with_labels matched = (map, List.filter moves (List.rev_append (List.combine a.labels b.labels) matched)) in
    Option.map with_labels (Task_isomorphism.matched context ~rename:(apply map) r r)
  | Some _ | None -> None

(* {1 Orbits} *)

(* Subtasks with one key in classes: the first of a class can be exchanged with each other one. To compare all with all
   would take too long where nothing fits. *)
let exchangeable check subtasks =
  let most_classes = 4 in
  let into (classes, found) subtask =
    let rec join before = function
      | [] -> (List.rev ([ subtask ] :: before), found)
      | members :: after when List.length before < most_classes -> (
          match check (List.hd members) subtask with
          | Some exchange -> (List.rev_append before ((subtask :: members) :: after), exchange :: found)
          | None -> join (members :: before) after)
      | classes -> (List.rev_append before ([ subtask ] :: classes), found)
    in
    join [] classes
  in
  let classes, found = List.fold_left into ([], []) subtasks in
  (List.filter (fun members -> List.compare_length_with members 1 > 0) (List.map List.rev classes), found)

(* By subtask, the pairs in which they differ, each once. *)
let orbit members : orbit =
  let first = List.hd members in
  let at p = List.map (fun pairs -> pairs.(p)) members in
  let differs p = List.exists (fun n -> n <> first.(p)) (at p) in
  let places = List.filter differs (List.init (Array.length first) Fun.id) in
  let add found p = if List.exists (fun q -> at q = at p) found then found else p :: found in
  let places = List.rev (List.fold_left add [] places) in
  Array.of_list (List.map (fun pairs -> Array.of_list (List.map (fun p -> pairs.(p)) places)) members)

let is_disjoint (orbit : orbit) =
  let all = List.concat_map Array.to_list (Array.to_list orbit) in
  List.length (List.sort_uniq Int.compare all) = List.length all

let overlaps (orbit : orbit) (orbit' : orbit) =
  let all = Array.concat (Array.to_list orbit') in
  Array.exists (Array.exists (fun n -> Array.mem n all)) orbit

let none = { orbits = []; labels = []; exchanges = [] }

let add_all check found subtasks =
  let classes, exchanges = exchangeable check subtasks in
  let add orbits members =
    let orbit = orbit (List.map (fun subtask -> subtask.pairs) members) in
    if Array.length orbit.(0) = 0 || (not (is_disjoint orbit)) || List.exists (overlaps orbit) orbits then orbits
    else orbit :: orbits
  in
  {
    orbits = List.fold_left add found.orbits classes;
    labels = List.concat_map snd exchanges @ found.labels;
    exchanges = List.map fst exchanges @ found.exchanges;
  }

let find ~tick context r ns =
  if not (is_clear context r) then None
  else
    let is_movable = movable context r in
    let check a b =
      tick ();
      checked context is_movable r ns a b
    in
    let several subtasks = List.compare_length_with subtasks 1 > 0 in
    let candidates = List.filter several (List.concat_map by_key (subtasks context r)) in
    let found = List.fold_left (add_all check) none candidates in
    if found.exchanges = [] || Task_isomorphism.labels r = [] then None
    else Some { found with orbits = List.rev found.orbits }
