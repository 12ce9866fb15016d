type candidates = { vehicles : int array; cost : (int -> int) option }

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

let rec ascends vehicles place =
  place >= Array.length vehicles || (vehicles.(place - 1) < vehicles.(place) && ascends vehicles (place + 1))

let candidates ~vehicles listed metres =
  let check vehicle = if vehicle < 0 || vehicle >= vehicles then invalid "Assignment.solve: no vehicle %d" vehicle in
  Array.iter check listed;
  if not (ascends listed 1) then invalid "Assignment.solve: the vehicles of a leaf do not ascend";
  { vehicles = listed; cost = Option.map (fun metres vehicle -> millimetres (metres vehicle)) metres }

let cost_nothing (candidates : candidates) =
  match candidates.cost with
  | None -> true
  | Some cost -> Array.for_all (fun vehicle -> cost vehicle = 0) candidates.vehicles

let same_vehicles (a : candidates) (b : candidates) =
  a.vehicles == b.vehicles
  || (Array.length a.vehicles = Array.length b.vehicles && Array.for_all2 Int.equal a.vehicles b.vehicles)

let equal_candidates (a : candidates) (b : candidates) =
  a == b
  || same_vehicles a b
     &&
     match a.cost, b.cost with
     | None, None -> true
     | None, Some _ -> cost_nothing b
     | Some _, None -> cost_nothing a
     | Some cost, Some cost' -> Array.for_all (fun vehicle -> cost vehicle = cost' vehicle) a.vehicles

let visit visit (candidates : candidates) =
  match candidates.cost with
  | None -> Array.iter (fun vehicle -> visit vehicle 0) candidates.vehicles
  | Some cost -> Array.iter (fun vehicle -> visit vehicle (cost vehicle)) candidates.vehicles

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
  let link { vehicles; _ } =
    let root = find vehicles.(0) in
    Array.iter (fun vehicle -> parent.(find vehicle) <- root) vehicles
  in
  let is_as_before leaf = leaf > 0 && candidates.(leaf).vehicles == candidates.(leaf - 1).vehicles in
  Array.iteri (fun leaf candidates -> if not (is_as_before leaf) then link candidates) candidates;
  let leaves = Hashtbl.create 16 and roots = ref [] in
  Array.iteri
    (fun leaf candidates ->
       let root = find candidates.vehicles.(0) in
       match Hashtbl.find_opt leaves root with
       | None ->
         roots := root :: !roots;
         Hashtbl.add leaves root [ leaf ]
       | Some others -> Hashtbl.replace leaves root (leaf :: others))
    candidates;
  List.rev_map (fun root -> Array.of_list (List.rev (Hashtbl.find leaves root))) !roots

let hash_candidates candidates =
  let hash = ref 0 in
  visit (fun vehicle cost -> hash := (((!hash * 31) + vehicle) * 1_000_003) lxor cost) candidates;
  !hash

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
         let is_twin other = equal_candidates candidates.(other) candidates.(row) in
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

let vehicles_of candidates leaves =
  let highest = Array.fold_left (fun most leaf -> Array.fold_left max most candidates.(leaf).vehicles) (-1) leaves in
  let is_listed = Array.make (highest + 1) false in
  let list place leaf =
    let { vehicles; _ } = candidates.(leaf) in
    let is_as_before = place > 0 && candidates.(leaves.(place - 1)).vehicles == vehicles in
    if not is_as_before then Array.iter (fun vehicle -> is_listed.(vehicle) <- true) vehicles
  in
  Array.iteri list leaves;
  Array.of_list (List.filter (Array.get is_listed) (List.init (highest + 1) Fun.id))

let by_vehicle columns =
  let column_of = Array.make (if columns = [||] then 0 else columns.(Array.length columns - 1) + 1) (-1) in
  Array.iteri (fun column vehicle -> column_of.(vehicle) <- column) columns;
  column_of

let make ~restricted candidates leaves =
  let own = Array.map (fun leaf -> candidates.(leaf)) leaves in
  let twin = twins (restricted leaves) own in
  let members = Array.make (Array.length leaves) [] in
  for row = Array.length leaves - 1 downto 0 do
    members.(twin.(row)) <- leaves.(row) :: members.(twin.(row))
  done;
  let members = Array.of_list (List.filter (fun members -> members <> []) (Array.to_list members)) in
  let groups = Array.map List.hd members in
  let columns = vehicles_of candidates groups in
  let column_of = by_vehicle columns in
  let width = Array.length columns in
  let cost = Array.make (Array.length groups * width) Matching.forbidden in
  Array.iteri
    (fun row leaf ->
       let size = List.length members.(row) in
       visit
         (fun vehicle millimetres -> cost.((row * width) + column_of.(vehicle)) <- size * millimetres)
         candidates.(leaf))
    groups;
  { cotree = restricted groups; groups; members; columns; cost }
