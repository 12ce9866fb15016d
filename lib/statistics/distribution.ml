type t = float array

let of_list xs =
  let d = Array.of_list xs in
  Array.sort Float.compare d;
  d

let is_empty d = d = [||]
let size = Array.length

let quantile q d =
  let n = Array.length d in
  if n = 0 then invalid_arg "Distribution.quantile";
  d.(max 0 (min (n - 1) (Float.to_int (Float.ceil (q *. Float.of_int n)) - 1)))

type bin = { from : float; until : float; count : int }

(* Widths that are easy to read, in milliseconds. *)
let widths =
  let decimal = List.concat_map (fun n -> [ n; 2 * n; 5 * n ]) [ 1; 10; 100 ] in
  let sixtieths unit = List.map (fun n -> n * unit) [ 1; 2; 5; 10; 15; 30 ] in
  decimal @ sixtieths 1_000 @ sixtieths 60_000 @ List.map (fun n -> n * 3_600_000) [ 1; 2; 6; 12; 24 ]

(* Whole milliseconds, the place of a number in spans of [width]. *)
let place width x = Float.to_int (Float.round (x *. 1000.)) / width
let spans width d = place width d.(Array.length d - 1) - place width d.(0) + 1

let bins ~most d =
  let day = 24 * 3_600_000 in
  let rec days n = if spans (n * day) d <= most then n * day else days (2 * n) in
  if d = [||] then []
  else begin
    let width = match List.find_opt (fun w -> spans w d <= most) widths with Some w -> w | None -> days 2 in
    let first = place width d.(0) in
    let counts = Array.make (spans width d) 0 in
    Array.iter (fun x -> let i = place width x - first in counts.(i) <- counts.(i) + 1) d;
    let edge i = Float.of_int ((first + i) * width) /. 1000. in
    List.mapi (fun i count -> { from = edge i; until = edge (i + 1); count }) (Array.to_list counts)
  end
