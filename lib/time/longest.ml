type 'edge graph = { successors : (int * 'edge) list array; order : int list }

exception Cycle

(* The vertices that 0 leads to, each before those that it leads to; [back ()] where that is not possible. *)
let sorted ~back n successors =
  let entered = Array.make n false and left = Array.make n false in
  let rec go order = function
    | [] -> order
    | (v, []) :: stack ->
      left.(v) <- true;
      go (v :: order) stack
    | (v, w :: others) :: stack ->
      let stack = (v, others) :: stack in
      if left.(w) then go order stack
      else if entered.(w) then begin back (); go order stack end
      else begin
        entered.(w) <- true;
        go order ((w, successors w) :: stack)
      end
  in
  if n = 0 then []
  else begin
    entered.(0) <- true;
    go [] [ (0, successors 0) ]
  end

let order n successors = sorted ~back:ignore n successors

let graph n edges =
  let successors = Array.make n [] in
  List.iter (fun (v, w, edge) -> successors.(v) <- (w, edge) :: successors.(v)) edges;
  let back () = raise_notrace Cycle in
  match sorted ~back n (fun v -> List.map fst successors.(v)) with
  | order -> Some { successors; order }
  | exception Cycle -> None

let ways g length =
  let n = Array.length g.successors in
  let longest = Array.make n (-1) and last = Array.make n None in
  let follow v (w, edge) =
    let by = length edge in
    let way = if longest.(v) = max_int || by = max_int then max_int else longest.(v) + by in
    if way > longest.(w) then begin
      longest.(w) <- way;
      last.(w) <- Some (v, edge)
    end
  in
  if n > 0 then longest.(0) <- 0;
  List.iter (fun v -> List.iter (follow v) g.successors.(v)) g.order;
  let rec back edges v = match last.(v) with Some (u, edge) -> back (edge :: edges) u | None -> edges in
  (longest, back [])
