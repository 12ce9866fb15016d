open Station_state

let most_nodes = 2000
let silence = 60.

let wants name s =
  Name_set.mem name s.bound || Expected.mem name s.expected || Names.mem name s.timeouts
  || List.mem_assoc name s.settings.payload
  || List.mem_assoc name s.settings.types

(* The reason for keeping [n]; [None]: it is kept in any case. *)
let worth ~now s (n : Node.t) =
  let spoke = n.last_heard > neg_infinity in
  if wants n.name s || n.claim <> None || not (Execution.is_settled ~now n.execution) then None
  else if not spoke then Some 0
  else if Execution.report n.execution = None then Some 1
  else if now -. Node.last_sign n > silence then Some 2
  else None

let host (n : Node.t) = match n.hosts with host :: _ -> host | [] -> Unix.inet_addr_any

(* Those of the host that has most of them. *)
let of_crowded_host nodes =
  let counts = Hashtbl.create 16 in
  let count n = Option.value (Hashtbl.find_opt counts (host n)) ~default:0 in
  List.iter (fun n -> Hashtbl.replace counts (host n) (count n + 1)) nodes;
  let most = List.fold_left (fun most n -> max most (count n)) 0 nodes in
  List.filter (fun n -> count n = most) nodes

(* The number forgotten together, which costs no more than one alone. *)
let several = 100

let least_recent nodes =
  let by_sign a b = Float.compare (Node.last_sign a) (Node.last_sign b) in
  List.filteri (fun i _ -> i < several) (List.sort by_sign nodes)

let forget (n : Node.t) s =
  gone n { s with systems = Systems.remove n s.systems; received = Received.forget n.id s.received }

let make_room ~now s =
  if Systems.cardinal s.systems < most_nodes then Some s
  else
    let ranked =
      List.filter_map (fun n -> Option.map (fun worth -> (worth, n)) (worth ~now s n)) (Systems.to_list s.systems) in
    let least = List.fold_left (fun least (worth, _) -> min least worth) max_int ranked in
    let candidates = List.filter_map (fun (worth, n) -> if worth = least then Some n else None) ranked in
    match least_recent (of_crowded_host candidates) with
    | [] -> None
    | least -> Some (List.fold_left (fun s n -> forget n s) s least)
