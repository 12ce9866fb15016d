type t = Little_endian | Big_endian

let pp ppf order =
  Format.pp_print_string ppf
    (match order with Little_endian -> "little-endian" | Big_endian -> "big-endian")
