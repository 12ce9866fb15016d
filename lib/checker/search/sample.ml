type t = {
  seed : int;
  mutable drawn : int;
  mutable from : int array;  (* by state: the one that it was first seen from *)
  mutable visits : int array;  (* by state *)
  mutable walks : int;
  mutable steps : int;
  mutable visited : int;
  mutable once : int;
  mutable twice : int;
}

let create ~seed =
  { seed; drawn = 0; from = [||]; visits = [||]; walks = 0; steps = 0; visited = 0; once = 0; twice = 0 }

(* {1 Chance} *)

(* The output function of SplitMix64 (Steele, Lea, Flood, 2014): the compiler's own generator changed with OCaml 5. *)
let mix z =
  let open Int64 in
  let z = mul (logxor z (shift_right_logical z 30)) 0xBF58476D1CE4E5B9L in
  let z = mul (logxor z (shift_right_logical z 27)) 0x94D049BB133111EBL in
  logxor z (shift_right_logical z 31)

let draw t n =
  t.drawn <- t.drawn + 1;
  let z = mix (Int64.add (mix (Int64.of_int t.seed)) (Int64.mul (Int64.of_int t.drawn) 0x9E3779B97F4A7C15L)) in
  Int64.to_int (Int64.shift_right_logical z 2) mod n

(* {1 States} *)

let room t i =
  if i >= Array.length t.from then begin
    let longer xs = Array.append xs (Array.make (max 1_024 (i + 1)) 0) in
    t.from <- longer t.from;
    t.visits <- longer t.visits
  end

let see t i ~from =
  room t i;
  t.from.(i) <- from

let from t i = t.from.(i)
let visited (t : t) = t.visited
let is_new t i = t.visits.(i) = 0

let visit t i =
  let n = t.visits.(i) + 1 in
  t.visits.(i) <- n;
  if n = 1 then t.visited <- t.visited + 1;
  t.once <- (t.once + if n = 1 then 1 else if n = 2 then -1 else 0);
  t.twice <- (t.twice + if n = 2 then 1 else if n = 3 then -1 else 0);
  t.steps <- t.steps + 1

let begin_walk t = t.walks <- t.walks + 1

(* {1 What is not seen} *)

type summary = { seed : int; walks : int; steps : int; visited : int; unvisited : float; states : float }

let summary (t : t) ~seen =
  let of_counts unvisited states =
    { seed = t.seed; walks = t.walks; steps = t.steps; visited = t.visited; unvisited; states }
  in
  let once = float_of_int t.once and twice = float_of_int t.twice in
  let more = once *. (once -. 1.) /. (2. *. (twice +. 1.)) in
  if t.visited = seen then of_counts 0. (float_of_int seen)
  else of_counts (once /. float_of_int (max 1 t.steps)) (Float.max (float_of_int t.visited +. more) (float_of_int seen))
