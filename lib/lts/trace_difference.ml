type t = First_only of string list | Second_only of string list | None | Not_known

(* The states that one trace reaches, from the first state and from the second: both not empty, ascending. *)
module Pairs = Hashtbl.Make (struct
    type t = int list * int list

    let equal (x, y) (x', y') = List.equal Int.equal x x' && List.equal Int.equal y y'
    let hash_set hash set = List.fold_left (fun hash s -> ((hash lxor (hash lsr 32)) * 0x1f3d5b79a2c4e683) + s) hash set

    let hash (x, y) =
      let mixed = hash_set (hash_set 1 x * 31) y in
      (mixed lxor (mixed lsr 32)) land max_int
  end)

type node = { states : int list * int list; trace : string list  (* the last label first *) }

let descending (l, s) (l', s') = match Int.compare l' l with 0 -> Int.compare s' s | order -> order

(* The labels by which states of [set] can go, and their successors, both in ascending order. *)
let moves g set =
  let all = List.concat_map (fun s -> Graph.fold_from g s (fun moves l target -> (l, target) :: moves) []) set in
  let add grouped (l, target) =
    match grouped with
    | (l', targets) :: rest when l = l' -> (l, target :: targets) :: rest
    | rest -> (l, [ target ]) :: rest
  in
  List.fold_left add [] (List.sort_uniq descending all)

exception Found of t

let find ~effort g s t =
  let seen = Pairs.create 1024 and queue = Queue.create () and looked_at = ref 0 in
  let visit trace ((x, y) as states) =
    if not (List.equal Int.equal x y || Pairs.mem seen states) then begin
      Pairs.add seen states ();
      looked_at := !looked_at + List.length x + List.length y;
      if !looked_at > effort then raise_notrace (Found Not_known);
      Queue.add { states; trace } queue
    end
  in
  let trace_of node l = Graph.label g l :: node.trace in
  let rec walk node x y =
    match (x, y) with
    | [], [] -> ()
    | (l, targets) :: x, (l', targets') :: y when l = l' ->
      visit (trace_of node l) (targets, targets');
      walk node x y
    | (l, _) :: _, (l', _) :: _ when l < l' -> raise_notrace (Found (First_only (List.rev (trace_of node l))))
    | (l, _) :: _, [] -> raise_notrace (Found (First_only (List.rev (trace_of node l))))
    | _, (l, _) :: _ -> raise_notrace (Found (Second_only (List.rev (trace_of node l))))
  in
  try
    visit [] ([ s ], [ t ]);
    while not (Queue.is_empty queue) do
      let node = Queue.pop queue in
      let x, y = node.states in
      walk node (moves g x) (moves g y)
    done;
    None
  with Found result -> result
