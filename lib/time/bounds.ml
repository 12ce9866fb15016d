type t = Within of { least : int; most : int } | Some_time | Never

let at_once = Within { least = 0; most = 0 }

(* Some 30,000 years: sums of them are far from overflow. *)
let longest = 1e15

let milliseconds seconds =
  let ms = Float.round (seconds *. 1000.) in
  if ms < longest then Some (Float.to_int ms) else None

let exactly seconds =
  match milliseconds seconds with Some n -> Within { least = n; most = n } | None -> Never

(* A product that should be whole may be off in its last digit. *)
let slightly = 1e-6

let between least most =
  let least = Float.floor ((least *. 1000.) +. slightly) and most = Float.ceil ((most *. 1000.) -. slightly) in
  if not (least < longest) then Never
  else if most < longest then Within { least = Float.to_int least; most = Float.to_int most }
  else Some_time

let from_the_start = function
  | Within { most; _ } -> Within { least = 0; most }
  | Some_time | Never -> Some_time

let compare = Stdlib.compare

let pp_time ppf ms =
  let seconds = ms / 1000 and rest = ms mod 1000 in
  let hours = seconds / 3600 and minutes = seconds / 60 mod 60 in
  if hours > 0 then Format.fprintf ppf "%d:%02d:%02d" hours minutes (seconds mod 60)
  else Format.fprintf ppf "%d:%02d" minutes (seconds mod 60);
  if rest > 0 then
    let digits = Printf.sprintf "%03d" rest in
    let rec trimmed n = if digits.[n - 1] = '0' then trimmed (n - 1) else String.sub digits 0 n in
    Format.fprintf ppf ".%s" (trimmed 3)
