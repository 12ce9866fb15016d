(* Row i, column j of an [n] by [n] matrix bounds x(i) - x(j). Place 0 is the constant 0, place 1 the date, and clock k
   stands at place k + 1. *)
type t = { n : int; m : int array }

let unbounded = max_int
let ( ++ ) a b = if a = unbounded || b = unbounded then unbounded else a + b
let zero = 0
let date = 1
let get z i j = Array.unsafe_get z.m ((i * z.n) + j)
let set z i j x = Array.unsafe_set z.m ((i * z.n) + j) x
let start = { n = 2; m = Array.make 4 0 }
let clocks z = z.n - 1
let copy z = { z with m = Array.copy z.m }

let contains z xs =
  let value i = if i = zero then 0 else xs.(i - 1) in
  let rec go i j = i = z.n || (if j = z.n then go (i + 1) 0 else value i - value j <= get z i j && go i (j + 1)) in
  go 0 0

let subset z z' =
  let rec go k = k < 0 || (Array.unsafe_get z.m k <= Array.unsafe_get z'.m k && go (k - 1)) in
  go (Array.length z.m - 1)

let equal z z' =
  let rec go k = k < 0 || (Array.unsafe_get z.m k = Array.unsafe_get z'.m k && go (k - 1)) in
  z.n = z'.n && go (Array.length z.m - 1)

(* Older clocks come last: zones that differ a little have their clocks in one order mostly, and may include each
   other. *)
let ranks z =
  let key k =
    let i = k + 2 in
    let with_ j = (get z i j, get z j i) in
    let others = List.map with_ (List.filter (( <> ) i) (List.init (z.n - 2) (( + ) 2))) in
    let younger = List.length (List.filter (fun (_, least) -> least <= 0) others) in
    (younger, with_ zero, with_ date, List.sort Stdlib.compare others)
  in
  let keys = Array.init (z.n - 2) key in
  let order = List.sort_uniq Stdlib.compare (Array.to_list keys) in
  let rank = Hashtbl.create 16 in
  List.iteri (fun i key -> Hashtbl.add rank key i) order;
  Array.map (Hashtbl.find rank) keys

let are_equal i j z = get z (i + 1) (j + 1) = 0 && get z (j + 1) (i + 1) = 0

let delayed z z' =
  (* At least [least] and at most [most], by the bounds of the date in both directions. *)
  let rec go i j least most =
    if i = z.n then if least <= most then most else -1
    else if j = z.n then go (i + 1) 0 least most
    else
      let mine = get z i j and other = get z' i j in
      if other = unbounded then go i (j + 1) least most
      else if mine = unbounded then -1
      else if i = j then go i (j + 1) least most
      else if i = date then go i (j + 1) least (min most (other - mine))
      else if j = date then go i (j + 1) (max least (mine - other)) most
      else if mine <= other then go i (j + 1) least most
      else -1
  in
  go 0 0 0 max_int

let earliest_date z = -get z zero date
let most clock z = match get z (clock + 1) zero with n when n = unbounded -> None | n -> Some n
let least clock z = match get z zero (clock + 1) with n when n = unbounded -> 0 | n -> max 0 (-n)
let latest_date z = match get z date zero with n when n = unbounded -> None | n -> Some n

let delay z =
  let z = copy z in
  for i = 1 to z.n - 1 do set z i zero unbounded done;
  z

(* [z] with x(a) - x(b) <= c besides: ways by that bound may be shorter. *)
let bounded a b c z =
  if c >= get z a b then Some z
  else if get z b a ++ c < 0 then None
  else begin
    let z = copy z in
    for i = 0 to z.n - 1 do
      let before = get z i a in
      if before <> unbounded then
        for j = 0 to z.n - 1 do
          let by = before + c ++ get z b j in
          if by < get z i j then set z i j by
        done
    done;
    Some z
  end

let at_least i n = bounded zero (i + 1) (-n)
let at_most i n = bounded (i + 1) zero n

let rearranged from z =
  let n = Array.length from + 2 in
  let place i = if i < 2 then i else match from.(i - 2) with Some k -> k + 1 | None -> zero in
  { n; m = Array.init (n * n) (fun k -> get z (place (k / n)) (place (k mod n))) }

let freed i z =
  let z = copy z and i = i + 1 in
  for j = 0 to z.n - 1 do
    if j <> i then begin
      set z i j unbounded;
      set z j i unbounded
    end
  done;
  z

let reaching_down z =
  let z = copy z in
  for i = 0 to z.n - 1 do if i <> date then set z i date unbounded done;
  z

let reaching_up z =
  let z = copy z in
  for j = 0 to z.n - 1 do if j <> date then set z date j unbounded done;
  z

let at_any_date z =
  let z = reaching_down z in
  for j = 0 to z.n - 1 do if j <> date then set z date j unbounded done;
  z
