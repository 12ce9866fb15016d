module Phrase = Dolphin_trace.Phrase

(* In one unit, if six digits are enough for that: 1.5 min; else in several: 20 min 34.56 s. *)
let rec duration seconds =
  let unit, name = if seconds >= 3600. then (3600., "h") else if seconds >= 60. then (60., "min") else (1., "s") in
  let short = Printf.sprintf "%g" (seconds /. unit) in
  if unit = 1. || float_of_string short *. unit = seconds || not (Float.is_finite seconds) then short ^ " " ^ name
  else
    let whole = Float.floor (seconds /. unit) in
    Printf.sprintf "%.0f %s %s" whole name (duration (seconds -. (whole *. unit)))

let most_named = 8

let vehicles vs =
  let n = List.length vs in
  let names vs = String.concat ", " (List.map Phrase.one_line vs) in
  if n <= most_named then names vs
  else
    let named = List.filteri (fun i _ -> i < most_named) vs in
    Printf.sprintf "%s and %d more" (names named) (n - most_named)
