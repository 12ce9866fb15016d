let time seconds =
  let whole = int_of_float (Float.floor (Float.min seconds 1e12 +. 1e-6)) in
  let minutes = whole / 60 mod 60 and hours = whole / 3600 in
  if hours > 0 then Printf.sprintf "%d:%02d:%02d" hours minutes (whole mod 60)
  else Printf.sprintf "%d:%02d" minutes (whole mod 60)

let count n what = Printf.sprintf "%d %s%s" n what (if n = 1 then "" else "s")
