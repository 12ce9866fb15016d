open Bands

type strip = { part : int; rightwards : bool }

(* Ways are asked for many times: by each tour that is tried, for its length, and for its points. *)
type t = { parts : part array; known : (strip * strip, (float * float) list) Hashtbl.t }

let make parts = { parts; known = Hashtbl.create 256 }

let starts parts s = if s.rightwards then parts.(s.part).left else parts.(s.part).right
let ends parts s = if s.rightwards then parts.(s.part).right else parts.(s.part).left
let long part = part.right -. part.left

(* {1 Ways through the region} *)

module Queue = Set.Make (struct
    type t = float * int

    let compare = compare
  end)

(* From a place in a part: the distance to each part, its entry, and the part before it, -1 if not known. *)
type reach = { costs : float array; at : float array; before : int array }

let clamp low high x = Float.max low (Float.min high x)

(* [visit part cost] for parts in the order of their costs, as long as it is true. *)
let explore parts reach (start, x) visit =
  let { costs; at; before } = reach in
  costs.(start) <- 0.;
  at.(start) <- x;
  let relax from queue (part, low, high) =
    let x = clamp low high at.(from) in
    let cost = costs.(from) +. Float.hypot (x -. at.(from)) (parts.(part).height -. parts.(from).height) in
    if cost < costs.(part) then begin
      costs.(part) <- cost;
      at.(part) <- x;
      before.(part) <- from;
      Queue.add (cost, part) queue
    end
    else queue
  in
  let rec go queue =
    match Queue.min_elt_opt queue with
    | None -> ()
    | Some ((cost, part) as least) ->
      let queue = Queue.remove least queue in
      if cost > costs.(part) then go queue
      else if visit part cost then go (List.fold_left (relax part) queue parts.(part).gates)
  in
  go (Queue.singleton (0., start))

let unknown parts =
  let n = Array.length parts in
  { costs = Array.make n infinity; at = Array.make n 0.; before = Array.make n (-1) }

(* The distance from [from], the beginning of [reach], to the end [x] of a part. *)
let cost_to parts reach (from, x_from) (part, x) =
  if part = from then Float.abs (x -. x_from)
  else
    let straight p x_p = Float.hypot (x -. x_p) (parts.(part).height -. parts.(p).height) in
    match reach.before.(part) with
    | -1 -> straight from x_from
    | p -> reach.costs.(p) +. straight p reach.at.(p)

let reach_of parts start =
  let reach = unknown parts in
  explore parts reach start (fun _ _ -> true);
  reach

let neighbours parts a b =
  a.part = b.part || List.mem b.part parts.(a.part).upper || List.mem b.part parts.(a.part).lower

let found_way parts a b =
  let reach = unknown parts in
  explore parts reach (a.part, ends parts a) (fun part _ -> part <> b.part);
  let rec back part points =
    match reach.before.(part) with
    | -1 -> points
    | p when p = a.part -> points
    | p -> back p ((reach.at.(p), parts.(p).height) :: points)
  in
  back b.part []

let way { parts; known } a b =
  if neighbours parts a b then []
  else
    match Hashtbl.find_opt known (a, b) with
    | Some way -> way
    | None ->
      let way = found_way parts a b in
      Hashtbl.add known (a, b) way;
      way

let gap ({ parts; _ } as t) a b =
  let x = ends parts a and y = parts.(a.part).height in
  let target = (starts parts b, parts.(b.part).height) in
  let add (sum, (x, y)) (x', y') = (sum +. Float.hypot (x' -. x) (y' -. y), (x', y')) in
  fst (List.fold_left add (0., (x, y)) (way t a b @ [ target ]))

let length ({ parts; _ } as t) strips =
  let rec go = function
    | a :: (b :: _ as rest) -> long parts.(a.part) +. gap t a b +. go rest
    | [ a ] -> long parts.(a.part)
    | [] -> 0.
  in
  go strips

(* {1 Stacks} *)

(* One of the ways to go along the strips of a stack; its length does not count the strips themselves. No two have the
   same number. *)
type mode = { number : int; stack : int; strips : strip list; first : strip; last : strip; inner : float }

let rec last = function [ x ] -> x | _ :: rest -> last rest | [] -> invalid_arg "Tour.last"

let mode t ~number stack strips =
  let rec inner = function a :: (b :: _ as rest) -> gap t a b +. inner rest | [ _ ] | [] -> 0. in
  { number; stack; strips; first = List.hd strips; last = last strips; inner = inner strips }

let there_and_back ~rightwards = List.mapi (fun i part -> { part; rightwards = rightwards = (i mod 2 = 0) })

(* Of a stack: up or down, to the left or to the right at first. *)
let most_modes = 4

let modes_of t stack members =
  let orders = match members with [ _ ] -> [ members ] | _ -> [ members; List.rev members ] in
  let both order = List.map (fun rightwards -> there_and_back ~rightwards order) [ true; false ] in
  let strips = List.concat_map both orders in
  Array.of_list (List.mapi (fun i strips -> mode t ~number:((most_modes * stack) + i) stack strips) strips)

(* Parts above one another without a choice between them. *)
let stacks parts =
  let next i = match parts.(i).upper with [ j ] when parts.(j).lower = [ i ] -> Some j | _ -> None in
  let continues i = match parts.(i).lower with [ j ] -> next j = Some i | _ -> false in
  let rec from i = i :: (match next i with Some j -> from j | None -> []) in
  List.filter_map
    (fun i -> if continues i then None else Some (from i))
    (List.init (Array.length parts) Fun.id)

(* {1 Orders} *)

(* From the end of one mode of [count] stacks to the beginning of another. *)
let distances parts ~count =
  let reaches = Hashtbl.create 64 and known = Array.make (most_modes * count) [||] in
  let reach from =
    match Hashtbl.find_opt reaches from with
    | Some reach -> reach
    | None ->
      let reach = reach_of parts from in
      Hashtbl.add reaches from reach;
      reach
  in
  fun a b ->
    if known.(a.number) = [||] then known.(a.number) <- Array.make (most_modes * count) nan;
    let cost = known.(a.number).(b.number) in
    if not (Float.is_nan cost) then cost
    else
      let from = (a.last.part, ends parts a.last) in
      let cost = cost_to parts (reach from) from (b.first.part, starts parts b.first) in
      known.(a.number).(b.number) <- cost;
      cost

let most_exact = 8

(* A centimetre, so that rounding does not choose. *)
let as_good = 10.

(* The best order of all: for each set of stacks and each mode of the first of them, the shortest tour. *)
let exact distance modes =
  let n = Array.length modes in
  let all = Array.concat (Array.to_list modes) in
  let m = Array.length all in
  let best = Array.make_matrix (1 lsl n) m infinity and after = Array.make_matrix (1 lsl n) m (-1) in
  Array.iteri (fun i mode -> best.(1 lsl mode.stack).(i) <- mode.inner) all;
  for set = 1 to (1 lsl n) - 1 do
    let put_first j i =
      let bit = 1 lsl all.(j).stack in
      if set land bit = 0 then begin
        let cost = all.(j).inner +. distance all.(j) all.(i) +. best.(set).(i) in
        if cost < best.(set lor bit).(j) then begin
          best.(set lor bit).(j) <- cost;
          after.(set lor bit).(j) <- i
        end
      end
    in
    for i = 0 to m - 1 do
      if best.(set).(i) < infinity then for j = 0 to m - 1 do put_first j i done
    done
  done;
  let full = (1 lsl n) - 1 in
  let least = Array.fold_left Float.min infinity best.(full) in
  let rec from set i =
    let rest = set land lnot (1 lsl all.(i).stack) in
    all.(i) :: (if rest = 0 then [] else from rest after.(set).(i))
  in
  let rec first i = if best.(full).(i) <= least +. as_good then i else first (i + 1) in
  from full (first 0)

(* On to the nearest stack that is left, and so on. *)
let greedy parts modes start =
  let left = Array.map (fun _ -> true) modes in
  let beginning = Array.make (Array.length parts) [] in
  Array.iter
    (Array.iter (fun mode -> beginning.(mode.first.part) <- mode :: beginning.(mode.first.part)))
    modes;
  let nearest current =
    let from = (current.last.part, ends parts current.last) in
    let reach = unknown parts and best = ref None in
    let least () = match !best with Some (cost, _) -> cost | None -> infinity in
    let consider mode =
      if left.(mode.stack) then begin
        let cost = cost_to parts reach from (mode.first.part, starts parts mode.first) in
        if cost < least () then best := Some (cost, mode)
      end
    in
    explore parts reach from (fun part cost ->
        List.iter consider beginning.(part);
        cost < least ());
    if !best = None then Array.iter (Array.iter consider) modes;
    Option.map snd !best
  in
  let rec go current tour =
    left.(current.stack) <- false;
    match nearest current with None -> List.rev (current :: tour) | Some next -> go next (current :: tour)
  in
  go start []

let most_moved = 40

(* A stack is put elsewhere, and gone along in another mode, as long as that makes the tour shorter. *)
let improved distance modes tour =
  let between a b = match a, b with Some a, Some b -> distance a b | None, _ | _, None -> 0. in
  let move tour i =
    let tour = Array.of_list tour in
    let n = Array.length tour in
    let rest = Array.of_list (List.filteri (fun j _ -> j <> i) (Array.to_list tour)) in
    let get a j = if j < 0 || j >= Array.length a then None else Some a.(j) in
    let removed =
      between (get tour (i - 1)) (Some tour.(i)) +. between (Some tour.(i)) (get tour (i + 1)) +. tour.(i).inner
      -. between (get tour (i - 1)) (get tour (i + 1))
    in
    let best = ref (removed -. 1e-3) and found = ref None in
    for j = 0 to n - 1 do
      let a = get rest (j - 1) and b = get rest j in
      Array.iter
        (fun mode ->
           let added = between a (Some mode) +. between (Some mode) b +. mode.inner -. between a b in
           if added < !best then begin best := added; found := Some (j, mode) end)
        modes.(tour.(i).stack)
    done;
    let insert (j, mode) =
      let before, after = List.partition (fun (k, _) -> k < j) (List.mapi (fun k m -> (k, m)) (Array.to_list rest)) in
      List.map snd before @ (mode :: List.map snd after)
    in
    Option.map insert !found
  in
  let rec pass tour i moved rounds =
    if i = List.length tour then if moved && rounds > 0 then pass tour 0 false (rounds - 1) else tour
    else match move tour i with Some tour -> pass tour (i + 1) true rounds | None -> pass tour (i + 1) moved rounds
  in
  pass tour 0 false 20

let most_starts = 8

(* Of many strips fewer tours are tried: the effort stays the same. *)
let starts_for parts = Int.max 1 (Int.min most_starts (1_000 / Array.length parts))

let tried ({ parts; _ } as t) modes =
  let n = Array.length modes in
  let starts = Int.min n (starts_for parts) in
  let first = List.init starts (fun i -> modes.(i * n / starts)) in
  let first = if starts = 1 then [ modes.(0).(0) ] else List.concat_map Array.to_list first in
  let tours = List.map (greedy parts modes) first in
  let distance = distances parts ~count:n in
  let tours = if n <= most_moved then List.map (improved distance modes) tours else tours in
  let length tour = length t (List.concat_map (fun mode -> mode.strips) tour) in
  let lengths = List.map (fun tour -> (length tour, tour)) tours in
  snd (List.hd (List.stable_sort (fun (a, _) (b, _) -> Float.compare a b) lengths))

let shortest ({ parts; _ } as t) =
  let stacks =
    if Array.length parts <= most_exact then List.init (Array.length parts) (fun i -> [ i ]) else stacks parts
  in
  let modes = Array.of_list (List.mapi (modes_of t) (List.rev stacks)) in
  let count = Array.length modes in
  let tour = if count <= most_exact then exact (distances parts ~count) modes else tried t modes in
  List.concat_map (fun mode -> mode.strips) tour
