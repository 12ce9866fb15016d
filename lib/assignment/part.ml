type candidates = (int * int) array

type t = {
  cotree : Cotree.t;
  groups : int array;
  members : int list array;
  columns : int array;
  cost : int array;
}

type outcome = Found of int array | Impossible of int list option | Undecided

let invalid format = Printf.ksprintf invalid_arg format

let millimetres metres =
  if not (metres >= 0.) then invalid "Assignment.solve: a cost of %g" metres
  else int_of_float (Float.round (Float.min metres 1e9 *. 1000.))

let candidates ~vehicles listed =
  let candidates =
    Array.map
      (fun (vehicle, metres) ->
         if vehicle < 0 || vehicle >= vehicles then invalid "Assignment.solve: no vehicle %d" vehicle;
         (vehicle, millimetres metres))
      listed
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
  let is_as_before leaf = leaf > 0 && candidates.(leaf) == candidates.(leaf - 1) in
  Array.iteri (fun leaf candidates -> if not (is_as_before leaf) then link candidates) candidates;
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

(* By row of [cotree], the least row that is one with it: they have the same [Any] parent and the same candidates.
   Moving one of two such leaves to the other's vehicle breaks nothing, and needs no further vehicle; so in the best
   allocation, were they apart, the move to the cheaper, or else to the lower vehicle, would be still better. *)
let twins (cotree : Cotree.t) candidates =
  let first = Hashtbl.create 16 in
  let twin = Array.make (Array.length candidates) 0 in
  Array.iteri
    (fun node kind ->
       match kind with
       | Cotree.All_different | Any -> ()
       | A_leaf row ->
         let parent = cotree.parent.(node) in
         let is_twin other = candidates.(other) == candidates.(row) || candidates.(other) = candidates.(row) in
         twin.(row) <-
           (if parent < 0 || cotree.kind.(parent) <> Any then row
            else
              let key = (parent, hash_candidates candidates.(row)) in
              match List.find_opt is_twin (Hashtbl.find_all first key) with
              | Some other -> other
              | None ->
                Hashtbl.add first key row;
                row))
    cotree.kind;
  twin

let make ~restricted candidates leaves =
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
  let cost = Array.make (Array.length groups * width) Matching.forbidden in
  Array.iteri
    (fun row leaf ->
       let size = List.length members.(row) in
       Array.iter
         (fun (vehicle, millimetres) ->
            cost.((row * width) + column_of.(vehicle)) <- size * millimetres)
         candidates.(leaf))
    groups;
  { cotree = restricted groups; groups; members; columns; cost }
