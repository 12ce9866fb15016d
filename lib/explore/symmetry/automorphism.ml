open Dolphin_semantics

type ring = int array array
type t = { rings : ring list; labels : (Task_isomorphism.label * Task_isomorphism.label) list }

(* {1 Pairs that may be renamed} *)

(* Pairs within one key only: what looks at any pair of a key sees the same. *)
let renamed patterns rename tuples =
  let again before (k, xs) =
    List.fold_left
      (fun (before, same) x ->
         let n = Skeleton.pair patterns k x in
         let n' = rename n in
         (Tuples.post k (Skeleton.value_of patterns n') before, same && n = n'))
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

let movable context r =
  let patterns = Task_isomorphism.patterns context in
  let of_code (handler, code) = (Skeleton.of_code patterns ~handler code).fixed in
  let add fixed code = Footprint.Pairs.union fixed (of_code code) in
  let fixed = List.fold_left add Footprint.Pairs.empty (Task_isomorphism.closures r) in
  fun n ->
    let pair = (Skeleton.key_of patterns n, Some (Skeleton.value_of patterns n)) in
    not (Footprint.Pairs.meet (Footprint.Pairs.singleton pair) fixed)

let is_clear context r =
  let clear (handler, code) = not (Skeleton.of_code (Task_isomorphism.patterns context) ~handler code).unclear in
  List.for_all clear (Task_isomorphism.closures r)

(* {1 What stands side by side} *)

type thing = { pairs : int array; labels : Task_isomorphism.label list; likeness : string }

let things context r =
  let patterns = Task_isomorphism.patterns context in
  let pair n = Skeleton.key_of patterns n and label _ = "" in
  let plain r =
    let likeness = Task_isomorphism.key context ~sorted:false ~pair ~label r in
    { pairs = Task_isomorphism.pairs context r; labels = Task_isomorphism.labels r; likeness }
  in
  let of_branch b = plain (Residual.One_of [ b ]) in
  let rec lists (r : Residual.t) =
    match r with
    | Ready _ | Running _ | Action _ | Condition _ | Idle _ -> []
    | Sequence (a, rest) -> List.concat_map lists (a :: rest)
    | Parallel rs -> List.map plain rs :: List.concat_map lists rs
    | All_of (a, bs) -> (List.map of_branch bs :: List.concat_map lists (Option.to_list a)) @ bodies bs
    | One_of bs -> List.map of_branch bs :: bodies bs
    | Until (_, a) | Watch (a, _) | During { body = a; _ } -> lists a
  and bodies bs = List.concat_map (fun (b : Residual.branch) -> lists b.body) bs in
  lists r

(* {1 Automorphisms} *)

(* The renaming that makes the one thing the other, and back. *)
let exchange is_movable a b =
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

let rename map n = Option.value (Hashtbl.find_opt map n) ~default:n

(* If the whole is the same after the exchange, there is an automorphism that puts [a] in the place of [b], and the
   other things where they fit. *)
let checked context is_movable r tuples a b =
  match exchange is_movable a.pairs b.pairs with
  | None -> None
  | Some map ->
    let rename = rename map in
    if Tuples.equal tuples (renamed (Task_isomorphism.patterns context) rename tuples) then
      Option.map (List.rev_append (List.combine a.labels b.labels)) (Task_isomorphism.matched context ~rename r r)
    else None

(* {1 Rings} *)

(* Where the things differ, once for each pair of theirs. *)
let own_pairs members =
  let first = List.hd members in
  let at p = List.map (fun pairs -> pairs.(p)) members in
  let differs p = List.exists (fun n -> n <> first.(p)) (at p) in
  let places = List.filter differs (List.init (Array.length first) Fun.id) in
  let add found p = if List.exists (fun q -> at q = at p) found then found else p :: found in
  let places = List.rev (List.fold_left add [] places) in
  Array.of_list (List.map (fun pairs -> Array.of_list (List.map (fun p -> pairs.(p)) places)) members)

let is_disjoint (ring : ring) =
  let all = List.concat_map Array.to_list (Array.to_list ring) in
  List.length (List.sort_uniq Int.compare all) = List.length all

let overlaps (ring : ring) (ring' : ring) =
  let all = Array.concat (Array.to_list ring') in
  Array.exists (Array.exists (fun n -> Array.mem n all)) ring

(* Things of one likeness in rows, within which each can change places with the next. To compare all with all would take
   too long if nothing fits. *)
let rows check things =
  let most_rows = 4 in
  let into (rows, labels) thing =
    let rec join before = function
      | [] -> (List.rev ([ thing ] :: before), labels)
      | row :: after when List.length before < most_rows -> (
          match check (List.hd row) thing with
          | Some found -> (List.rev_append before ((thing :: row) :: after), List.rev_append found labels)
          | None -> join (row :: before) after)
      | rows -> (List.rev_append before ([ thing ] :: rows), labels)
    in
    join [] rows
  in
  let rows, labels = List.fold_left into ([], []) things in
  (List.filter (fun row -> List.compare_length_with row 1 > 0) (List.map List.rev rows), labels)

let by_likeness things =
  let groups = Hashtbl.create 16 in
  let add order thing =
    match Hashtbl.find_opt groups thing.likeness with
    | Some same -> same := thing :: !same; order
    | None ->
      let same = ref [ thing ] in
      Hashtbl.add groups thing.likeness same;
      same :: order
  in
  let order = List.rev (List.fold_left add [] things) in
  List.map (fun same -> List.rev !same) order

let find context r tuples =
  if not (is_clear context r) then None
  else begin
    let is_movable = movable context r in
    let check = checked context is_movable r tuples in
    let groups = List.concat_map by_likeness (things context r) in
    let groups = List.filter (fun group -> List.compare_length_with group 1 > 0) groups in
    let group found things =
      let rows, labels = rows check things in
      let ring found members =
        let ring = own_pairs (List.map (fun thing -> thing.pairs) members) in
        if Array.length ring.(0) = 0 || (not (is_disjoint ring)) || List.exists (overlaps ring) found then found
        else ring :: found
      in
      { rings = List.fold_left ring found.rings rows; labels = labels @ found.labels }
    in
    let found = List.fold_left group { rings = []; labels = [] } groups in
    if found.labels = [] then None else Some { found with rings = List.rev found.rings }
  end
